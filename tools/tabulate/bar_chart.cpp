#include "tools/tabulate/bar_chart.hpp"

#include <algorithm>
#include <cmath>

#include "tools/tabulate/table.hpp"

namespace sediment::tabulate {
namespace {

constexpr double kLeft = 58, kTop = 64, kHeight = 280, kBar = 24, kBetween = 34, kBottom = 92;
constexpr const char* kColors[] = {"#64707a", "#9fb0b8", "#0d6e60", "#c4701c", "#7d5ba6", "#b3261e"};

std::string escaped_xml(const std::string& text) {
  std::string all;
  for (const char c : text) all += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return all;
}

std::string label(double x, double y, const std::string& content, const char* more) {
  return formatted("<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, more) + escaped_xml(content) + "</text>\n";
}

/// A step of 1, 2 or 5 times a power of ten, about five of them.
double step_of(double most) {
  const double power = std::pow(10, std::floor(std::log10(most / 5)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (most / (factor * power) <= 6) return factor * power;
  return 10 * power;
}

std::vector<std::string> names_in(const std::vector<BarGroup>& groups) {
  std::vector<std::string> names;
  for (const BarGroup& group : groups)
    for (const Bar& bar : group.bars)
      if (std::find(names.begin(), names.end(), bar.name) == names.end()) names.push_back(bar.name);
  return names;
}

std::string grid(double most, double width) {
  std::string text;
  const double step = step_of(most);
  for (double value = 0; value <= most * 1.0001; value += step) {
    const double y = kTop + kHeight * (1 - value / most);
    text += formatted("<line x1=\"%.0f\" x2=\"%.0f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#e3e0d8\"/>\n", kLeft,
                      width - 12, y, y);
    text += label(kLeft - 8, y + 4, formatted("%g", value), "text-anchor=\"end\"");
  }
  return text;
}

}  // namespace

std::string bar_chart(const std::vector<BarGroup>& groups, const std::string& title,
                      const std::string& axis) {
  const auto names = names_in(groups);
  double most = 1e-9, width = kLeft + kBetween;
  for (const BarGroup& group : groups) {
    for (const Bar& bar : group.bars) most = std::max(most, bar.value);
    width += static_cast<double>(group.bars.size()) * kBar + kBetween;
  }
  most *= 1.08;
  width = std::max(width, kLeft + 40 + 150 * static_cast<double>(names.size()));
  std::string text = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" "
      "font-size=\"11\" fill=\"#333\">\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
      width, kTop + kHeight + kBottom);
  text += label(12, 20, title, "font-size=\"14\" font-weight=\"600\"") +
          label(12, kTop - 14, axis, "fill=\"#777\"");
  text += grid(most, width);
  double x = kLeft + kBetween / 2;
  for (const BarGroup& group : groups) {
    const double middle = x + static_cast<double>(group.bars.size()) * kBar / 2;
    for (const Bar& bar : group.bars) {
      const auto color =
          static_cast<std::size_t>(std::find(names.begin(), names.end(), bar.name) - names.begin());
      const double height = kHeight * bar.value / most;
      text += formatted("<rect x=\"%.1f\" y=\"%.2f\" width=\"%.0f\" height=\"%.2f\" fill=\"%s\"/>\n", x + 1.5,
                        kTop + kHeight - height, kBar - 3, height, kColors[color % std::size(kColors)]);
      text += label(x + kBar / 2, kTop + kHeight - height - 4, bar.text,
                    "text-anchor=\"middle\" font-size=\"9\"");
      x += kBar;
    }
    text += formatted("<g transform=\"translate(%.1f %.1f) rotate(-20)\">", middle + 8, kTop + kHeight + 18) +
            label(0, 0, group.name, "text-anchor=\"end\"") + "</g>\n";
    x += kBetween;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double at = 12 + 150 * static_cast<double>(i);
    text += formatted("<rect x=\"%.0f\" y=\"%.0f\" width=\"11\" height=\"11\" fill=\"%s\"/>\n", at, kTop - 38,
                      kColors[i % std::size(kColors)]);
    text += label(at + 16, kTop - 28, names[i], "");
  }
  return text + "</svg>\n";
}

}  // namespace sediment::tabulate
