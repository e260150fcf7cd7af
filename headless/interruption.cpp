#include "headless/interruption.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace kinegraph {

namespace {

// A signal handler gets no argument of ours: what it reaches must be static.
std::atomic<StopToken*> listening{nullptr};
std::atomic<int> received{0};

extern "C" void on_signal(int number) {
  StopToken* token = listening.load();
  if (received.exchange(number) != 0 || !token) _exit(128 + number);
  token->stop();
}

}  // namespace

void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void leave(int code) {
  std::fflush(nullptr);
  std::_Exit(code);
}

Interruption::Interruption() {
  listening.store(&token_);
  end_on_signals();
}

Interruption::~Interruption() {
  listening.store(nullptr);
}

int Interruption::exit_code() const {
  int number = received.load();
  return number ? 128 + number : 0;
}

}  // namespace kinegraph
