// One call to a reader on any bytes: what the fuzzers and the mutation test share. A reader answers with a
// value or a Failure; anything else is a bug.
#pragma once
#include <string>
#include <string_view>

#include "nodes/files/acclaim_motion.h"
#include "nodes/files/analysis_file.h"
#include "nodes/files/bvh_read.h"
#include "nodes/files/bvh_write.h"

namespace kinegraph {

inline bool read_bvh_once(std::string_view text) {
  Alone work;
  try {
    const Motion motion = read_bvh(text, {}, work);
    if (motion.non_finite()) throw std::logic_error("a motion that was read is not finite");
    write_bvh(motion, {}, work);
    return true;
  } catch (const Failure&) {
    return false;
  }
}

inline bool read_amc_once(std::string_view asf, std::string_view amc) {
  Alone work;
  try {
    const Motion motion = acclaim_motion(read_asf(asf, work), amc, {}, work);
    if (motion.non_finite()) throw std::logic_error("a motion that was read is not finite");
    return true;
  } catch (const Failure&) {
    return false;
  }
}

inline bool read_analysis_once(std::string_view text) {
  try {
    Alone work;
    return read_analysis(text, work).value != nullptr;
  } catch (const Failure&) {
    return false;
  }
}

}  // namespace kinegraph
