#include "gui/document/problem_text.h"

#include <QFileInfo>
#include <QObject>
#include <QRegularExpression>

namespace kinegraph {
namespace {

bool of_a_clip(const Diagnostic& problem) {
  return !problem.file.empty() && !QString::fromStdString(problem.file).endsWith(".kg.json");
}

// As a person writes: a capital at the start, where that is a word and no name, and a stop at the end.
QString sentence(QString text) {
  int letters = 0;
  while (letters < text.size() && text[letters].isLetter()) ++letters;
  if (letters > 0 && letters < text.size() && (text[letters] == ' ' || text[letters] == ','))
    text[0] = text[0].toUpper();
  if (!text.isEmpty() && !QString(".!?:…").contains(text.back())) text += '.';
  return text;
}

}  // namespace

QString with_quotes(const QString& text) {
  static const QRegularExpression plain(R"(\"([^\"\n]*)\"|`([^`\n]*)`|(?<![\w'])'([^'\n]*)'(?![\w']))");
  QString quoted;
  qsizetype from = 0;
  for (auto found = plain.globalMatch(text); found.hasNext();) {
    const QRegularExpressionMatch one = found.next();
    quoted += text.mid(from, one.capturedStart() - from) + "“" + one.captured(1) + one.captured(2) +
              one.captured(3) + "”";
    from = one.capturedEnd();
  }
  return quoted + text.mid(from);
}

Severity shown_severity(const Diagnostic& problem) {
  const bool waits = problem.code == "open-input" || problem.code == "blocked";
  return waits && problem.severity == Severity::error ? Severity::warning : problem.severity;
}

QString problem_text(const Diagnostic& problem) {
  QString text = with_quotes(QString::fromStdString(problem.message));
  if (const QString joint = QString::fromStdString(problem.joint); !joint.isEmpty() && !text.contains(joint))
    text += QObject::tr(", joint %1").arg(joint);
  if (problem.frame) text += QObject::tr(", frame %1").arg(*problem.frame);
  if (of_a_clip(problem) && problem.place.line > 0) {
    const QString name = QFileInfo(QString::fromStdString(problem.file)).fileName();
    text = QObject::tr("%1, line %2: %3").arg(name).arg(problem.place.line).arg(text);
    return text.endsWith('.') ? text : text + '.';
  }
  return sentence(text);
}

QString place_of(const Diagnostic& problem) {
  QString where = QString::fromStdString(problem.node);
  if (const std::string& part = problem.port.empty() ? problem.param : problem.port; !part.empty())
    where += (where.isEmpty() ? "" : ".") + QString::fromStdString(part);
  if (of_a_clip(problem) || problem.place.line <= 0) return where;
  const QString line = QObject::tr("line %1").arg(problem.place.line);
  return where.isEmpty() ? line : where + ", " + line;
}

QString advice_on(const Diagnostic& problem) {
  if (problem.code == "missing-file")
    return QObject::tr("Choose another file, or let “Find missing files…” (Ctrl+Shift+R) look for it.");
  const QString hint = sentence(with_quotes(QString::fromStdString(problem.hint)));
  if (!hint.isEmpty() || !of_a_clip(problem) || problem.severity != Severity::error) return hint;
  const QString name = QFileInfo(QString::fromStdString(problem.file)).fileName();
  return problem.place.line > 0
             ? QObject::tr(
                   "The file is damaged. Mend that line in a text editor, export the clip again, or choose "
                   "another file; %1 is read again as soon as it changes.")
                   .arg(name)
             : QObject::tr(
                   "The file is damaged or of another kind. Export the clip again or choose another file; "
                   "%1 is read again as soon as it changes.")
                   .arg(name);
}

}  // namespace kinegraph
