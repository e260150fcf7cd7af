// The picture of any value.
#pragma once
#include <string>

#include "graph/value.h"
#include "headless/draws/canvas.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

struct PictureOptions {
  std::string title;
  int moments = 0;  // of a strip; 0 = as many as look good
  // What belongs to the value, where it is known: a motion's contacts, the motion that contacts were found
  // in or that a character makes.
  const Contacts* contacts = nullptr;
  const Motion* motion = nullptr;
};
// Throws Failure ("no-picture") for a type that has none.
Canvas picture_of(const Value& value, const PictureOptions& options);

}  // namespace kinegraph
