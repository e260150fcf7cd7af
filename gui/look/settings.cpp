#include "gui/look/settings.h"

namespace kinegraph {

std::unique_ptr<QSettings> user_settings() {
  const QString file = qEnvironmentVariable("KINEGRAPH_SETTINGS");
  if (!file.isEmpty()) return std::make_unique<QSettings>(file, QSettings::IniFormat);
  return std::make_unique<QSettings>(QSettings::IniFormat, QSettings::UserScope, "kinegraph", "editor");
}

}  // namespace kinegraph
