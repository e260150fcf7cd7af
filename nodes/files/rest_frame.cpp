#include "nodes/files/rest_frame.h"

#include <algorithm>
#include <vector>

#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// Sums over the joints, rad.
double step(const Motion& motion, std::size_t from) {
  double sum = 0;
  for (int j = 0; j < motion.joints(); ++j)
    sum += turn(motion.rotation(j)[from], motion.rotation(j)[from + 1]);
  return sum;
}
double distance_from_rest(const Motion& motion, std::size_t frame) {
  double sum = 0;
  for (int j = 1; j < motion.joints(); ++j)  // the root faces anywhere
    sum += turn(motion.rotation(j)[frame], motion.skeleton().joints[j].rest);
  return sum;
}

}  // namespace

bool starts_with_rest_frame(const Motion& motion) {
  if (motion.frames() < 4 || motion.joints() < 3) return false;
  std::vector<double> later;
  for (std::size_t t = 2; t + 1 < motion.frames() && t < 10; ++t) later.push_back(step(motion, t));
  std::nth_element(later.begin(), later.begin() + static_cast<std::ptrdiff_t>(later.size() / 2), later.end());
  const double usual = later[later.size() / 2], jump = step(motion, 0);
  const double least = 1.5 / degrees_per_radian * motion.joints();
  return jump > 5 * usual && jump > least &&
         2 * distance_from_rest(motion, 0) < distance_from_rest(motion, 1);
}

void warn_about_rest_frame(const Motion& motion, std::size_t file_frame, Work& work) {
  if (file_frame == 0 && starts_with_rest_frame(motion))
    work.report(warning("rest-frame", "frame 0 looks like a T-pose put in front of the clip")
                    .hinting("Load's rest_frame drop leaves it out")
                    .at_param("rest_frame")
                    .at_frame(0));
}

}  // namespace kinegraph
