#include "experiment/spread_table.hpp"

#include <fmt/format.h>

#include <limits>

namespace laneloom::experiment {
namespace {

constexpr double kLeastWay = 0.1;

std::string title(const DriveSpec& drive) {
  return fmt::format("{} {} {}", drive.road->name, drive.noise.name, drive.seed);
}

class Spread {
 public:
  void add(double value, const DriveSpec& drive) {
    values_.add(value);
    if (value >= worst_) return;
    worst_ = value;
    worst_drive_ = title(drive);
  }
  /// A text "mean/worst decile/worst", in percent.
  std::string values() const {
    if (values_.count() == 0) return "-/-/-";
    return fmt::format("{:.1f}/{:.1f}/{:.1f}", 100 * values_.mean(), 100 * values_.quantile(0.1),
                       100 * worst_);
  }
  std::uint64_t count() const { return values_.count(); }
  const std::string& worst_drive() const { return worst_drive_; }

 private:
  Distribution values_;
  double worst_ = std::numeric_limits<double>::infinity();
  std::string worst_drive_ = "-";
};

double f1(const SubjectResult& result) { return result.measures.score.markings().f1(); }

std::string row(const std::vector<DriveSpec>& drives, const std::vector<DriveResults>& results,
                std::size_t subject) {
  Spread lines, lanes, way;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const DriveResults& of_drive = results[i];
    const double raw = f1(of_drive.front()), oracle = f1(of_drive.back()), own = f1(of_drive[subject]);
    lines.add(own, drives[i]);
    const evaluation::Score& lane = of_drive[subject].measures.score.of(evaluation::LineKind::lane);
    if (lane.truths > 0) lanes.add(lane.f1(), drives[i]);
    if (oracle - raw > kLeastWay) way.add((own - raw) / (oracle - raw), drives[i]);
  }
  return fmt::format("| {} | {} ({} drives) | {} | {} | {} |\n", results.front()[subject].name, way.values(),
                     way.count(), lines.values(), lanes.values(), way.worst_drive());
}

}  // namespace

std::string spread_table(const std::vector<DriveSpec>& drives, const std::vector<DriveResults>& results) {
  std::string table = fmt::format(
      "| {} drives: mean/worst decile/worst | way from raw to oracle % | F1 % | lanes F1 % | worst way |\n"
      "|---|---|---|---|---|\n",
      drives.size());
  if (results.empty()) return table;
  for (std::size_t subject = 0; subject + 1 < results.front().size(); ++subject)
    table += row(drives, results, subject);
  return table;
}

}  // namespace laneloom::experiment
