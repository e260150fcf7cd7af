#include "headless/draws/picture.h"

#include "graph/diagnostic.h"
#include "headless/draws/character_sheet.h"
#include "headless/draws/contact_bars.h"
#include "headless/draws/sheets.h"
#include "headless/draws/strip.h"

namespace kinegraph {

namespace {

bool stands_still(const Motion& motion) {
  for (int joint = 0; joint < motion.joints(); ++joint)
    for (std::size_t t = 1; t < motion.frames(); ++t)
      if (turn(motion.rotation(joint)[0], motion.rotation(joint)[t]) > 1e-6 ||
          norm(motion.local_offset(joint, t) - motion.local_offset(joint, 0)) > 1e-6)
        return false;
  return true;
}

}  // namespace

Canvas picture_of(const Value& value, const PictureOptions& options) {
  if (auto motion = dynamic_cast<const Motion*>(&value)) {
    StripOptions strip{.title = options.title, .moments = options.moments, .contact_bars = false};
    return draw_strips({{motion, "", options.contacts}}, strip);
  }
  if (auto contacts = dynamic_cast<const Contacts*>(&value)) {
    if (!options.motion || options.motion->frames() != contacts->frames)
      return draw_contacts(*contacts, options.title);
    StripOptions strip{.title = options.title, .subtitle = facts_of(*contacts), .moments = options.moments};
    return draw_strips({{options.motion, "", contacts}}, strip);
  }
  if (auto character = dynamic_cast<const Character*>(&value)) {
    // A face that only its morph targets move has no poses to show.
    if (!options.motion || (!character->morph_tracks.empty() && stands_still(*options.motion)))
      return draw_character(*character, options.title, options.moments);
    StripOptions strip{.title = options.title,
                       .subtitle = facts_of(*options.motion) + " · " + facts_of(*character),
                       .moments = options.moments,
                       .contact_bars = false};
    return draw_strips({{options.motion, "", options.contacts, character}}, strip);
  }
  if (auto points = dynamic_cast<const Points*>(&value))
    return draw_points(*points, options.title, options.moments);
  if (auto warp = dynamic_cast<const Warp*>(&value)) return draw_warp(*warp, options.title);
  if (auto stats = dynamic_cast<const Stats*>(&value)) return draw_stats(*stats, options.title);
  if (auto components = dynamic_cast<const Components*>(&value))
    return draw_components(*components, options.title);
  if (auto metrics = dynamic_cast<const Metrics*>(&value))
    return is_meaning(*metrics) ? draw_meaning(*metrics, options.title)
                                : draw_metrics(*metrics, options.title);
  throw Failure(error("no-picture", "a value of type " + std::string(value.type()) + " has no picture")
                    .hinting("draw an output of type Motion, Character, Points, Components, Contacts, Warp, "
                             "Stats or Metrics"));
}

}  // namespace kinegraph
