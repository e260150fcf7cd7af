// Names of metrics that belong to a joint.
#pragma once
#include <string>
#include <string_view>

namespace kinegraph {

// NAME.JOINT with every character of the joint's name outside [A-Za-z0-9_.-] as "_".
std::string joint_metric_name(std::string_view name, std::string_view joint);

}  // namespace kinegraph
