#include "headless/interruption.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace kinegraph {

namespace {

// A signal handler gets no argument of ours: what it reaches must be static.
std::atomic<StopToken*> listening{nullptr};
std::atomic<int> received{0};

extern "C" void on_signal(int number) {
  if (received.exchange(number) != 0) _exit(128 + number);
  if (StopToken* token = listening.load()) token->stop();
}

void install(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  listening.store(&token_);
  install(on_signal);
}

Interruption::~Interruption() {
  install(SIG_DFL);
  listening.store(nullptr);
}

int Interruption::exit_code() const {
  int number = received.load();
  return number ? 128 + number : 0;
}

}  // namespace kinegraph
