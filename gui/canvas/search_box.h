// A line to type into with a list of what fits below it: search-to-add, and find a node. It lies over the
// canvas as a child of it, so that it needs no window of its own.
#pragma once
#include <QFrame>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <functional>
#include <vector>

namespace kinegraph {

class SearchBox : public QFrame {
  Q_OBJECT

 public:
  struct Entry {
    QString name, detail, help;
    QStringList keywords;
  };
  explicit SearchBox(QWidget* parent);
  // Shows it at a place of the parent; `chosen` gets the entry's index once.
  void open(QPoint at, const QString& prompt, std::vector<Entry> entries, std::function<void(int)> chosen);
  void cancel();
  void stay_inside();  // of the parent, which has another size

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void filter();
  void choose();

  QLineEdit* line_;
  QListWidget* list_;
  QLabel* help_;
  std::vector<Entry> entries_;
  std::function<void(int)> chosen_;
};

}  // namespace kinegraph
