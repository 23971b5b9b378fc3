#include "render/plot.hpp"

#include <gtest/gtest.h>

#include <cairo.h>

#include <cstddef>
#include <limits>
#include <stdexcept>

#include "temporary_folder.hpp"

namespace laneloom {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The columns of a picture, left to right, in which a pixel is nearly of the pure colour red.
std::vector<int> red_columns(const std::string& path) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
  const int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  std::vector<int> columns;
  for (int x = 0; x < width; ++x) {
    for (int y = 100; y < height; ++y) {                                       // below the legend
      const unsigned char* pixel = data + y * stride + std::ptrdiff_t{4} * x;  // blue, green, red
      if (pixel[2] < 200 || pixel[1] > 60 || pixel[0] > 60) continue;
      columns.push_back(x);
      break;
    }
  }
  cairo_surface_destroy(surface);
  return columns;
}

render::Plot plot(std::vector<Eigen::Vector2d> points) {
  return {.title = "title", .x_label = "x", .y_max = 1.0, .curves = {{"red", {1, 0, 0}, points}}};
}

TEST(Plot, TicksAreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(render::tick_step(100.0, 4), 50.0);
  EXPECT_DOUBLE_EQ(render::tick_step(100.0, 5), 20.0);
  EXPECT_DOUBLE_EQ(render::tick_step(35.0, 10), 5.0);
  EXPECT_DOUBLE_EQ(render::tick_step(0.7, 4), 0.2);
  EXPECT_DOUBLE_EQ(render::tick_step(10.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(render::tick_step(0.0, 4), 1.0);
  EXPECT_DOUBLE_EQ(render::tick_step(std::numeric_limits<double>::infinity(), 4), 1.0);
}

TEST(Plot, ACurveCoversItsAxisAndHasGapsWhereNothingIsKnown) {
  const TemporaryFolder folder;
  render::draw_plots({plot({{0, 0.5}, {1, 0.5}, {2, 0.5}, {3, 0.5}})}, folder.file("whole.png"));
  render::draw_plots({plot({{0, 0.5}, {1, 0.5}, {1.5, kNone}, {2, 0.5}, {3, 0.5}})}, folder.file("gap.png"));
  const auto whole = red_columns(folder.file("whole.png")), gap = red_columns(folder.file("gap.png"));
  ASSERT_GT(whole.size(), 1000u);  // of 1520 pixels
  EXPECT_EQ(whole.back() - whole.front() + 1, static_cast<int>(whole.size())) << "no column without it";
  EXPECT_NEAR(static_cast<double>(gap.size()), 2.0 / 3.0 * static_cast<double>(whole.size()), 8.0);
  EXPECT_EQ(gap.front(), whole.front());
  EXPECT_EQ(gap.back(), whole.back());
}

TEST(Plot, NothingToDrawIsStillAPicture) {
  const TemporaryFolder folder;
  render::draw_plots({plot({}), plot({{2.0, kNone}}), plot({{2.0, 0.0}})}, folder.file("empty.svg"));
  EXPECT_NE(content(folder.file("empty.svg")).find("</svg>"), std::string::npos);
  EXPECT_THROW(render::draw_plots({plot({})}, folder.file("plot.pdf")), std::runtime_error);
  EXPECT_THROW(render::draw_plots({plot({})}, folder.file("none/plot.png")), std::runtime_error);
}

}  // namespace
}  // namespace laneloom
