// When each part of a foot is planted: a bar a plant, a row a part, over a time axis.
#pragma once
#include <string>

#include "headless/draws/canvas.h"
#include "nodes/motion/contacts.h"

namespace kinegraph {

// Between x0 (first frame) and x1 (last), from y down; returns the y below it. Labels stand left of x0.
double draw_contact_bars(Canvas& canvas, const Contacts& contacts, double x0, double x1, double y);
// "12 plants · planted 63 % of the time · floor at 0.01 m"
std::string facts_of(const Contacts& contacts);
Canvas draw_contacts(const Contacts& contacts, const std::string& title);

}  // namespace kinegraph
