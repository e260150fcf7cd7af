#include "gui/panels/arithmetic.h"

#include <cmath>

namespace kinegraph {
namespace {

class Reader {
 public:
  explicit Reader(const QString& text) : text_(text) {}
  std::optional<double> whole() {
    take('=');  // as in a spreadsheet
    const auto value = sum();
    skip();
    if (!value || at_ != text_.size() || !std::isfinite(*value)) return {};
    return value;
  }

 private:
  void skip() {
    while (at_ < text_.size() && text_[at_].isSpace()) ++at_;
  }
  bool take(char sign) {
    skip();
    if (at_ >= text_.size() || text_[at_] != QLatin1Char(sign)) return false;
    ++at_;
    return true;
  }
  std::optional<double> sum() {
    auto value = product();
    while (value) {
      const bool plus = take('+');
      if (!plus && !take('-')) break;
      const auto other = product();
      if (!other) return {};
      *value += plus ? *other : -*other;
    }
    return value;
  }
  std::optional<double> product() {
    auto value = sign();
    while (value) {
      const bool times = take('*');
      if (!times && !take('/')) break;
      const auto other = sign();
      if (!other) return {};
      *value = times ? *value * *other : *value / *other;
    }
    return value;
  }
  std::optional<double> sign() {
    if (take('-')) {
      const auto value = sign();
      if (!value) return {};
      return -*value;
    }
    if (take('+')) return sign();
    auto base = atom();
    if (base && take('^')) {
      const auto exponent = sign();
      if (!exponent) return {};
      return std::pow(*base, *exponent);
    }
    return base;
  }
  std::optional<double> atom() {
    if (take('(')) {
      const auto value = sum();
      if (!value || !take(')')) return {};
      return value;
    }
    skip();
    const qsizetype start = at_;
    while (at_ < text_.size()) {
      const QChar c = text_[at_];
      const bool exponent_sign = (c == '+' || c == '-') && at_ > start && text_[at_ - 1].toLower() == 'e';
      if (!c.isDigit() && c != '.' && c != ',' && c.toLower() != 'e' && !exponent_sign) break;
      ++at_;
    }
    bool good = false;
    const double value = text_.mid(start, at_ - start).replace(',', '.').toDouble(&good);
    if (!good) return {};
    return value;
  }

  QString text_;
  qsizetype at_ = 0;
};

}  // namespace

std::optional<double> calculated(const QString& text) {
  return Reader(text).whole();
}

}  // namespace kinegraph
