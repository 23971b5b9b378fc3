#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "commands/evaluation_tables.hpp"
#include "render/plot.hpp"

namespace laneloom::commands {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kColours{drawing::Colour{0.87, 0.49, 0.13}, drawing::Colour{0.12, 0.38, 0.74}};

/// Precision, recall and lateral error over a common axis.
class SamplePlots {
 public:
  explicit SamplePlots(const std::string& x_label, bool binned)
      : plots_{{.title = "Precision of samples [%]", .x_label = x_label, .y_max = 100.0, .binned = binned},
               {.title = "Recall of samples [%]", .x_label = x_label, .y_max = 100.0, .binned = binned},
               {.title = "Mean lateral error [cm]", .x_label = x_label, .binned = binned}} {}

  void begin_curves(const std::string& who, const drawing::Colour& colour) {
    for (render::Plot& plot : plots_) plot.curves.push_back({who, colour, {}});
  }
  void add(double x, const evaluation::SampleScore& score) {
    add(0, x, score.predictions > 0 ? 100.0 * score.precision() : kNone);
    add(1, x, score.truths > 0 ? 100.0 * score.recall() : kNone);
    add(2, x, score.right > 0 ? 100.0 * score.lateral_error_m() : kNone);
  }
  std::vector<render::Plot>& plots() { return plots_; }

 private:
  void add(std::size_t plot, double x, double y) { plots_[plot].curves.back().points.emplace_back(x, y); }

  std::vector<render::Plot> plots_;
};

std::vector<render::Plot> over_time(const std::vector<NamedEvaluation>& evaluations) {
  SamplePlots samples("time [s]", false);
  render::Plot jitter{.title = "Mean jitter from frame to frame [cm]", .x_label = "time [s]"};
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    const auto& [who, evaluation] = evaluations[i];
    samples.begin_curves(who, kColours.at(i));
    jitter.curves.push_back({who, kColours.at(i), {}});
    const auto& moments = evaluation.profile().over_time();
    const auto& jitters_m = evaluation.stability().jitter_over_time_m();
    for (std::size_t k = 0; k < moments.size(); ++k) {
      const double t_s = static_cast<double>(moments[k].stamp_ns - moments.front().stamp_ns) * 1e-9;
      samples.add(t_s, moments[k].score);
      jitter.curves.back().points.emplace_back(t_s, 100.0 * jitters_m[k].value_or(kNone));
    }
  }
  samples.plots().push_back(std::move(jitter));
  return samples.plots();
}

std::vector<render::Plot> over_range(const std::vector<NamedEvaluation>& evaluations) {
  SamplePlots samples("distance ahead [m]", true);
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    const auto& [who, evaluation] = evaluations[i];
    samples.begin_curves(who, kColours.at(i));
    for (const auto& [bin, score] : evaluation.profile().over_range())
      samples.add((bin + 0.5) * evaluation::kRangeBin_m, score);
  }
  return samples.plots();
}

}  // namespace

void draw_evaluation(const std::vector<NamedEvaluation>& evaluations, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": " + error.message());
  for (const char* extension : {".svg", ".png"}) {
    draw_plots(over_time(evaluations), folder / (std::string("over_time") + extension));
    draw_plots(over_range(evaluations), folder / (std::string("over_range") + extension));
  }
}

}  // namespace laneloom::commands
