#include "graph/evaluate/memory_ledger.h"

#include <fmt/format.h>
#include <unistd.h>

#include <mutex>

namespace kinegraph {

struct MemoryLedger::Account {
  mutable std::mutex mutex;
  std::uint64_t limit = 0;
  std::uint64_t used = 0;

  // Takes what fits, or says how much is lacking.
  std::uint64_t take(std::size_t bytes) {
    std::lock_guard lock(mutex);
    if (bytes > limit || used > limit - bytes) return used + bytes - limit;
    used += bytes;
    return 0;
  }
  void give_back(std::size_t bytes) {
    std::lock_guard lock(mutex);
    used -= bytes;
  }
};

namespace {

// Keeps the value itself, and gives its bytes back after it.
template <class Account>
struct Holder {
  ValuePtr value;
  std::shared_ptr<Account> account;
  std::size_t bytes = 0;
  void operator()(const Value*) {
    value.reset();
    account->give_back(bytes);
  }
};

std::string mebibytes(std::uint64_t bytes) {
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
}

}  // namespace

MemoryLedger::MemoryLedger(MemoryCache* cache) : account_(std::make_shared<Account>()), cache_(cache) {
  limit_to(0);
}

void MemoryLedger::limit_to(std::uint64_t bytes) {
  if (bytes == 0) {
    bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
            static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 2;
  }
  std::lock_guard lock(account_->mutex);
  account_->limit = bytes;
}

void MemoryLedger::admit(std::size_t bytes, const char* what) {
  auto lacking = account_->take(bytes);
  while (lacking > 0 && cache_ && cache_->free_up(lacking) > 0) lacking = account_->take(bytes);
  if (lacking == 0) return;
  std::lock_guard lock(account_->mutex);
  throw Failure(error("out-of-memory",
                      fmt::format("{} needs {}, but {} of the {} allowed are in use", what, mebibytes(bytes),
                                  mebibytes(account_->used), mebibytes(account_->limit)))
                    .hinting("give more with --memory, or shorten the motions"));
}

ValuePtr MemoryLedger::hold(ValuePtr value) {
  using Mine = Holder<Account>;
  if (!value) return value;
  if (const auto* holder = std::get_deleter<Mine>(value); holder && holder->account == account_) return value;
  const auto* raw = value.get();
  const std::size_t bytes = value->bytes();
  admit(bytes, "a result");
  return ValuePtr(raw, Mine{std::move(value), account_, bytes});
}

std::shared_ptr<void> MemoryLedger::reserve(std::size_t bytes) {
  admit(bytes, "working memory");
  return std::shared_ptr<void>(nullptr, [account = account_, bytes](void*) { account->give_back(bytes); });
}

std::uint64_t MemoryLedger::used() const {
  std::lock_guard lock(account_->mutex);
  return account_->used;
}

}  // namespace kinegraph
