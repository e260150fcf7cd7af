// The editor's few icons, drawn in the theme's ink so that they fit both themes and any resolution.
#pragma once
#include <QIcon>

#include "gui/look/theme.h"

namespace kinegraph {

enum class Sign {
  run,
  stop,
  undo,
  redo,
  add,
  theme,
  graph,
  open,
  save,
  reset,
  publish,
  folder,
  clip,
  remove,
  tree,
  follow,
  frame,
  eye,
  file,
  new_file,
  computer,
  home,
  back,
  forward,
  up,
  new_folder,
  list,
  details,
  dock_out,
  keys,
  info,
  question,
  warning,
  error,
  done
};
QIcon icon(Sign sign, const Theme& theme);

}  // namespace kinegraph
