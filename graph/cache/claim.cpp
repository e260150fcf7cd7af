#include "graph/cache/claim.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>

#include "graph/cache/cache_folder.h"

namespace kinegraph {

std::unique_ptr<Claim> Claim::wait_for(const std::string& folder, const Key& key,
                                       const std::function<bool()>& give_up) {
  if (make_folders(folder)) return nullptr;
  const int file = ::open((folder + "/claims").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return nullptr;
  std::unique_ptr<Claim> claim(new Claim(file));
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(key.low & 0x3fffffffffffffffu);
  lock.l_len = 1;
  using std::chrono::milliseconds;
  for (milliseconds pause{1};; pause = std::min(2 * pause, milliseconds{16})) {
    if (::fcntl(file, F_OFD_SETLK, &lock) == 0) return claim;
    if (errno != EAGAIN && errno != EACCES && errno != EINTR) return nullptr;
    if (give_up && give_up()) return nullptr;
    std::this_thread::sleep_for(pause);
  }
}

Claim::~Claim() {
  ::close(file_);  // and with its description the lock
}

}  // namespace kinegraph
