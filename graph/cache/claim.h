// The right to compute a key, which only one holder has at a time among all processes, on all machines, that
// share a cache folder: what one is at work on the others wait for instead of computing it too.
//
// It is a lock on one byte of FOLDER/claims, at a place that the key tells (an open file description's lock,
// see fcntl(2)). The system lets go of it when its holder ends, however that ends, so nothing is ever left
// behind.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "graph/key.h"

namespace kinegraph {

class Claim {
 public:
  // Waits for it; `give_up` is asked every few milliseconds. Null where that says so, and where the folder
  // can't be written or its file system has no locks: then each computes for itself, which is never wrong.
  static std::unique_ptr<Claim> wait_for(const std::string& folder, const Key& key,
                                         const std::function<bool()>& give_up);
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  explicit Claim(int file) : file_(file) {}
  int file_;
};

}  // namespace kinegraph
