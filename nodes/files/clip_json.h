// Motions and Points as JSON that reads back without loss, as a part of an analysis file. Structure is plain;
// the long time series are strings: their doubles, little-endian, in base64.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graph/json.h"
#include "graph/work.h"
#include "nodes/motion/motion.h"
#include "nodes/motion/points.h"

namespace kinegraph {

Json clip_json(const Motion& motion, Work& work);
Json clip_json(const Points& points, Work& work);
Json skeleton_json(const Skeleton& skeleton);
// Throw Failure ("bad-analysis") with line and column.
Motion motion_of_json(const Json& json, Work& work);
Points points_of_json(const Json& json, Work& work);
Skeleton skeleton_of_json(const Json& json);

std::string base64(std::string_view bytes);
bool from_base64(std::string_view text, std::string& bytes);  // false: not base64

}  // namespace kinegraph
