#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "drawing/map_elements.hpp"
#include "drawing/truth.hpp"
#include "render/figure.hpp"
#include "temporary_folder.hpp"

namespace laneloom {
namespace {

Marking marking(MarkingType type, const Polyline& points, MarkingStyle style, double length_m) {
  Marking m;
  m.type = type;
  m.points = points;
  m.styles = {{{0.0, length_m}, style}};
  return m;
}

/// One lane straight ahead between a solid laneline (y = 2) and a roadedge (y = -2), a stopline, all seen
/// from a vehicle that looks along map y.
render::Figure small_figure() {
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  T_map_body.translate(Point(100, 200, 0)).rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Point::UnitZ()));
  const auto in_map = [&](Polyline line) {
    for (Point& point : line) point = T_map_body * point;
    return line;
  };
  simulation::Road truth;
  truth.markings = {{.id = 1, .points = in_map({{0, 10, 0}, {20, 10, 0}})}};
  LocalMap map;
  map.boundaries = {
      marking(MarkingType::laneline, in_map({{0, 2, 0}, {20, 2, 0}}), MarkingStyle::solid, 20.0),
      marking(MarkingType::roadedge, in_map({{0, -2, 0}, {20, -2, 0}}), MarkingStyle::unknown, 20.0)};
  map.stoplines.resize(1);
  map.stoplines[0].marking =
      marking(MarkingType::stopline, in_map({{15, -8, 0}, {15, -4, 0}}), MarkingStyle::unknown, 4.0);
  render::Panel panel{"map", {}};
  add_truth(truth, panel.drawing);
  add_map(map, panel.drawing);
  return {"figure", {}, {{"t = 0 s", T_map_body, {panel}}}};
}

class Render : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  const TemporaryFolder folder_;
};

/// A picture read back.
class Png {
 public:
  explicit Png(const std::string& path) : surface_(cairo_image_surface_create_from_png(path.c_str())) {}
  ~Png() { cairo_surface_destroy(surface_); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  bool good() const { return cairo_surface_status(surface_) == CAIRO_STATUS_SUCCESS; }

  /// The colour channel that stands out most in a part of the picture: 'r', 'g', 'b', or ' ' for none.
  char strongest(double top, double bottom, double left, double right) const {
    const int width = cairo_image_surface_get_width(surface_),
              height = cairo_image_surface_get_height(surface_);
    char found = ' ';
    int best = 60;  // grey has no channel that stands out
    for (int y = static_cast<int>(top * height); y < static_cast<int>(bottom * height); ++y) {
      for (int x = static_cast<int>(left * width); x < static_cast<int>(right * width); ++x) {
        const auto [channel, lead] = leading(x, y);
        if (lead > best) found = channel, best = lead;
      }
    }
    return found;
  }

 private:
  std::pair<char, int> leading(int x, int y) const {
    const unsigned char* pixel =
        cairo_image_surface_get_data(surface_) + y * cairo_image_surface_get_stride(surface_) + 4 * x;
    const int blue = pixel[0], green = pixel[1], red = pixel[2];
    return std::max({std::pair{'r', red - std::max(green, blue)}, std::pair{'g', green - std::max(red, blue)},
                     std::pair{'b', blue - std::max(red, green)}},
                    [](const auto& a, const auto& b) { return a.second < b.second; });
  }

  cairo_surface_t* surface_;
};

TEST_F(Render, DrawsMarkingsWhereTheVehicleSeesThem) {
  draw_figure(small_figure(), file("map.png"));
  const Png png(file("map.png"));
  ASSERT_TRUE(png.good());
  // Ahead is up: what lies 10 m ahead is above the middle. Left of the vehicle is left in the picture.
  EXPECT_EQ(png.strongest(0.50, 0.518, 0.35, 0.48), 'r');
  EXPECT_EQ(png.strongest(0.50, 0.518, 0.52, 0.65), 'g');
  EXPECT_EQ(png.strongest(0.40, 0.455, 0.60, 0.75), 'b');
  EXPECT_EQ(png.strongest(0.50, 0.518, 0.66, 0.95), ' ');
}

TEST_F(Render, WritesSvgWithTheSameStrokes) {
  draw_figure(small_figure(), file("map.svg"));
  std::ifstream in(file("map.svg"));
  std::ostringstream text;
  text << in.rdbuf();
  const std::string svg = text.str();
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("<path"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST_F(Render, RefusesOtherExtensionsAndUnwritablePlaces) {
  EXPECT_THROW(draw_figure(small_figure(), file("map.bmp")), std::runtime_error);
  EXPECT_THROW(draw_figure(small_figure(), file("no_such_folder/map.png")), std::runtime_error);
  EXPECT_THROW(draw_figure(small_figure(), file("no_such_folder/map.svg")), std::runtime_error);
}

TEST_F(Render, DrawsDegenerateElementsWithoutFailing) {
  LocalMap map;
  map.boundaries.emplace_back().points.resize(1, Point::Zero());
  map.lanes.emplace_back();
  map.linkages.emplace_back();
  render::Figure figure = small_figure();
  add_map(map, figure.moments[0].panels[0].drawing);
  EXPECT_NO_THROW(draw_figure(figure, file("odd.png")));
}

}  // namespace
}  // namespace laneloom
