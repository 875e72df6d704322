#include "docs/draw/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace bahnwerk::draw {

namespace {

constexpr double resolution = 0.04;  // px by which a drawn line may leave the computed one

std::string number(double value, int digits = 2) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  std::string s = text.data();
  if (s.find('.') != std::string::npos) {
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
  }
  return s == "-0" ? "0" : s;
}

/// Round values inside a range, some seven of them.
std::vector<double> ticks(Range range) {
  const double raw = (range.to - range.from) / 7, power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (raw <= factor * power) step = factor * power;
  std::vector<double> values;
  const auto first = static_cast<int>(std::ceil(range.from / step - 1e-9));
  for (int i = first; i * step <= range.to + 1e-9 * step; ++i) values.push_back(i * step);
  return values;
}

/// Douglas and Peucker: keeps what the eye can see.
void thin(const Line& p, std::size_t a, std::size_t b, std::vector<bool>& keep) {
  double most = 0;
  std::size_t at = a;
  const double dx = p[b].x - p[a].x, dy = p[b].y - p[a].y, length = std::hypot(dx, dy);
  for (std::size_t i = a + 1; i < b; ++i) {
    const double x = p[i].x - p[a].x, y = p[i].y - p[a].y;
    const double off = length > 0 ? std::abs(x * dy - y * dx) / length : std::hypot(x, y);
    if (off > most) {
      most = off;
      at = i;
    }
  }
  if (most <= resolution) return;
  keep[at] = true;
  thin(p, a, at, keep);
  thin(p, at, b, keep);
}

}  // namespace

Chart::Chart(Frame frame) : frame_(std::move(frame)) {
  if (!frame_.legend) top_ = 40;
  if (frame_.x_label.empty()) bottom_ = 34;
  if (frame_.equal_scale) {
    const double scale = (frame_.width - left_ - frame_.right) / (frame_.x.to - frame_.x.from);
    frame_.height = top_ + bottom_ + scale * (frame_.y.to - frame_.y.from);
  }
  legend_x_ = left_;
  axes();
}

double Chart::px(double x) const {
  return left_ + (x - frame_.x.from) / (frame_.x.to - frame_.x.from) * (frame_.width - left_ - frame_.right);
}

double Chart::py(double y) const {
  const double plot = frame_.height - top_ - bottom_;
  return top_ + plot * (1 - (y - frame_.y.from) / (frame_.y.to - frame_.y.from));
}

void Chart::text(double x, double y, const std::string& words, const std::string& extra) {
  body_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + extra + ">" + words + "</text>\n";
}

void Chart::axes() {
  text(left_, 24, frame_.title, "font-size=\"16\" font-weight=\"600\"");
  const double bottom = frame_.height - bottom_, right = frame_.width - frame_.right;
  for (const double x : ticks(frame_.x)) {
    body_ += "<path d=\"M" + number(px(x)) + " " + number(top_) + "V" + number(bottom) + "\" stroke=\"#e6e8eb\"/>\n";
    text(px(x), bottom + 18, number(x, 3), "text-anchor=\"middle\" fill=\"#444\"");
  }
  for (const double y : ticks(frame_.y)) {
    body_ += "<path d=\"M" + number(left_) + " " + number(py(y)) + "H" + number(right) + "\" stroke=\"#e6e8eb\"/>\n";
    text(left_ - 8, py(y) + 4.5, number(y, 3), "text-anchor=\"end\" fill=\"#444\"");
  }
  body_ += "<path d=\"M" + number(left_) + " " + number(top_) + "V" + number(bottom) + "H" + number(right) +
           "\" fill=\"none\" stroke=\"#444\"/>\n";
  text(0.5 * (left_ + right), frame_.height - 12, frame_.x_label, "text-anchor=\"middle\"");
  const double middle = 0.5 * (top_ + bottom);
  text(20, middle, frame_.y_label, "text-anchor=\"middle\" transform=\"rotate(-90 20 " + number(middle) + ")\"");
}

void Chart::line(const Line& points, const Style& style, const std::string& label) {
  if (points.size() < 2) return;
  const double reach = 4 * frame_.height;  // far outside the frame is far enough
  Line p;
  for (const Point& point : points) p.push_back({px(point.x), std::clamp(py(point.y), -reach, 2 * reach)});
  std::vector<bool> keep(p.size(), false);
  keep.front() = keep.back() = true;
  thin(p, 0, p.size() - 1, keep);
  const std::string look = "stroke=\"" + style.colour + "\" stroke-width=\"" + number(style.width) + "\"" +
                           (style.dash.empty() ? "" : " stroke-dasharray=\"" + style.dash + "\"") +
                           (style.opacity < 1 ? " opacity=\"" + number(style.opacity) + "\"" : "") +
                           (style.round ? " stroke-linecap=\"round\"" : "");
  std::string path;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (keep[i]) path += (path.empty() ? "M" : "L") + number(p[i].x) + " " + number(p[i].y);
  body_ += "<path d=\"" + path + "\" fill=\"none\" stroke-linejoin=\"round\" clip-path=\"url(#" + frame_.id + ")\" " +
           look + "/>\n";
  if (label.empty()) return;
  body_ += "<path d=\"M" + number(legend_x_) + " 47h26\" " + look + "/>\n";
  legend(label);
}

void Chart::legend(const std::string& label) {
  text(legend_x_ + 32, 51.5, label, "fill=\"#222\"");
  const auto letters = std::count_if(label.begin(), label.end(), [](char c) { return (c & 0xC0) != 0x80; });  // UTF-8
  legend_x_ += 46 + 6.4 * static_cast<double>(letters);
}

std::string Chart::colour(double fraction) {
  struct Rgb {
    double r, g, b;
  };
  static constexpr std::array<Rgb, 6> stops{
      {{49, 54, 149}, {42, 120, 190}, {36, 160, 130}, {150, 180, 40}, {240, 150, 20}, {190, 20, 30}}};
  const double x = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  const double t = x - static_cast<double>(i);
  const auto mix = [t](double a, double b) { return static_cast<int>(std::lround(a + t * (b - a))); };
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(mix(stops[i].r, stops[i + 1].r)),
                static_cast<unsigned>(mix(stops[i].g, stops[i + 1].g)),
                static_cast<unsigned>(mix(stops[i].b, stops[i + 1].b)));
  return text.data();
}

void Chart::colour_bar(Range values, const std::string& label) {
  const double x = frame_.width - frame_.right + 22, bottom = frame_.height - bottom_, height = bottom - top_;
  constexpr int steps = 48;
  for (int i = 0; i < steps; ++i)
    body_ += "<rect x=\"" + number(x) + "\" y=\"" + number(bottom - height * (i + 1) / steps) +
             "\" width=\"16\" height=\"" + number(height / steps + 0.5) + "\" fill=\"" + colour((i + 0.5) / steps) +
             "\"/>\n";
  for (const double v : ticks(values))
    text(x + 22, bottom - height * (v - values.from) / (values.to - values.from) + 4.5, number(v), "fill=\"#444\"");
  text(x - 4, top_ - 12, label, "fill=\"#222\"");
}

void Chart::note(Point at, const std::string& words, const std::string& anchor) {
  text(px(at.x), py(at.y), words, "fill=\"#555\" text-anchor=\"" + anchor + "\"");
}

void Chart::tube(const Line& points, double reach, const std::string& colour, const std::string& label) {
  const double scale = px(1) - px(0);
  std::string path;
  for (const Point& p : points) path += (path.empty() ? "M" : "L") + number(px(p.x)) + " " + number(py(p.y));
  body_ += "<path d=\"" + path + "\" fill=\"none\" stroke-linejoin=\"round\" clip-path=\"url(#" + frame_.id +
           ")\" stroke=\"" + colour + "\" stroke-width=\"" + number(2 * reach * scale) + "\" opacity=\"0.6\"/>\n";
  body_ += "<rect x=\"" + number(legend_x_) + "\" y=\"41\" width=\"26\" height=\"12\" opacity=\"0.6\" fill=\"" +
           colour + "\"/>\n";
  legend(label);
}

void Chart::save(const std::string& file) const { save(file, {*this}); }

void Chart::save(const std::string& file, const std::vector<Chart>& charts) {
  double height = 0;
  std::string clips, body;
  for (const Chart& c : charts) {
    const Frame& f = c.frame_;
    clips += "<clipPath id=\"" + f.id + "\"><rect x=\"" + number(c.left_ - 1) + "\" y=\"" + number(c.top_ - 2) +
             "\" width=\"" + number(f.width - c.left_ - f.right + 2) + "\" height=\"" +
             number(f.height - c.top_ - c.bottom_ + 4) + "\"/></clipPath>\n";
    body += height > 0 ? "<g transform=\"translate(0 " + number(height) + ")\">\n" + c.body_ + "</g>\n" : c.body_;
    height += f.height;
  }
  std::ofstream out(file);
  const std::string w = number(charts.front().frame_.width), h = number(height);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << w << " " << h << "\" width=\"" << w
      << "\" height=\"" << h << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\">\n"
      << clips << "<rect width=\"" << w << "\" height=\"" << h << "\" fill=\"#ffffff\"/>\n"
      << body << "</svg>\n";
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file);
}

}  // namespace bahnwerk::draw
