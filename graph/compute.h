// What a node's compute function sees of the world: its inputs, its parameters, its files, and where results go.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graph/param.h"
#include "graph/value.h"
#include "graph/work.h"

namespace kinegraph {

// Bytes of a file, shared and unchanging.
using FileBytes = std::shared_ptr<const std::string>;

class FileAccess {
 public:
  virtual ~FileAccess() = default;
  // The whole file, hashed as it is read. Throws Failure ("missing-file", "not-a-regular-file", "outside-sandbox",
  // "unreadable-file") that names the path as the user wrote it.
  virtual FileBytes read(const std::string& absolute_path) = 0;
  virtual bool exists(const std::string& absolute_path) = 0;                          // a regular file
  virtual std::vector<std::string> list(const std::string& absolute_folder) = 0;     // names, sorted
};

class Compute {
 public:
  virtual ~Compute() = default;

  virtual const Params& params() const = 0;
  virtual Work& work() = 0;
  virtual FileAccess& files() = 0;

  // Links of a port that resolved to a value; empty where it is open. A required port has one.
  virtual std::span<const ValuePtr> values(std::string_view port) const = 0;
  // Whether the output is wanted; a node may leave out an unwanted one that is dear.
  virtual bool wanted(std::string_view output) const = 0;
  virtual void set_output(std::string_view port, ValuePtr value) = 0;

  // Export: writes `bytes` for the save_file parameter, aside and renamed; `companion` names a further file beside it
  // (a .bin). Check: tells a rule's outcome; NaN value or limit = could not be measured.
  virtual void write_file(std::string_view param, std::string_view bytes, std::string_view companion = {}) = 0;
  virtual void rule(std::string_view text, double value, double limit, bool passed) = 0;

  template <class T>
  const T& input(std::string_view port) const {
    return dynamic_cast<const T&>(*values(port).front());
  }
  template <class T>
  std::shared_ptr<const T> shared_input(std::string_view port) const {
    return std::dynamic_pointer_cast<const T>(values(port).front());
  }
  template <class T>
  const T* optional_input(std::string_view port) const {
    auto all = values(port);
    return all.empty() ? nullptr : dynamic_cast<const T*>(all.front().get());
  }
  template <class T>
  void output(std::string_view port, T value) {
    set_output(port, std::make_shared<const T>(std::move(value)));
  }
};

}  // namespace kinegraph
