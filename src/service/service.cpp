#include "service/service.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <utility>

#include "base/clock.hpp"
#include "base/random_id.hpp"
#include "base/seconds.hpp"
#include "laneloom/error.hpp"
#include "laneloom/state_names.hpp"

namespace laneloom::service {
namespace {

constexpr double kStatisticsWindow_s = 10.0;
constexpr double kAskEvery_s = 0.5, kDeafAfter_s = 3.0;

std::size_t ticks_within(double window_s, double rate_hz) {
  return static_cast<std::size_t>(std::ceil(window_s * rate_hz));
}

double milliseconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) / 1e6; }

}  // namespace

Service::Service(const Config& config, std::function<std::int64_t()> now_ns,
                 std::function<void()> frame_is_ready)
    : config_(config),
      now_ns_(std::move(now_ns)),
      core_(config, {now_ns_, system_now_ns, random_id}),
      queue_(config, std::move(frame_is_ready)),
      work_(ticks_within(kStatisticsWindow_s, config.service.tick_rate_hz)),
      delay_(ticks_within(kStatisticsWindow_s, config.service.tick_rate_hz)),
      incidents_(config.service.status_period_s) {
  reopen();  // first: if it throws, the snapshot is kept, which resume() takes
  if (!config.service.snapshot_file.empty()) {
    resume();
    snapshots_ = std::make_unique<snapshot::SnapshotWriter>(config.service.snapshot_file);
  }
}

void Service::resume() {
  const std::string file = snapshot::take_snapshot(config_.service.snapshot_file);
  if (file.empty()) return;
  try {
    core_.resume(
        read_snapshot(file, core_.snapshot_stamp(), config_.service.snapshot_max_age_s, config_.mapper));
    counters_.add("snapshots_resumed");
    spdlog::info("event=resumed file={} lanes={}", file, core_.session().map().lanes.size());
  } catch (const std::exception& error) {
    counters_.add("snapshots_refused");
    spdlog::warn("event=snapshot_refused file={} why=\"{}\"", file, error.what());
  }
}

void Service::check_reopening() {
  dds::check_files(config_.dds);
  if (config_.dds.security_directory.empty()) return;
  try {
    const Endpoints trial(config_, core_.session_id(), queue_, now_ns_, dds::Participant::Presence::hidden);
  } catch (const dds::NotPermitted& error) {
    throw ConfigError(error.what());
  }
}

void Service::reopen() {
  if (endpoints_) counters_.add(endpoints_->refused_datagrams());
  endpoints_.reset();  // before the new ones are made, or others would see two services of one vehicle
  endpoints_ = std::make_unique<Endpoints>(config_, core_.session_id(), queue_, now_ns_);
}

void Service::tick(const core::Tick& tick) {
  const bool another = endpoints_->ros2 && endpoints_->ros2->has_another_writer();
  if (another) queue_.note_other_service(tick.start_ns);
  core::Messages messages = core_.tick(tick, take_arrivals());
  publish(messages.map, messages.road_markings);
  ask_itself(tick.start_ns);
  if (messages.snapshot) snapshots_->write(std::move(*messages.snapshot));
  work_.add(milliseconds(now_ns_() - tick.start_ns));
  delay_.add(milliseconds(tick.start_ns - tick.deadline_ns));
  log_tick(tick, messages);
  if (!messages.status) return;
  messages.status->tick = work_.summary();
  messages.status->tick_delay = delay_.summary();
  publish(*messages.status);
  incidents_.note(*messages.status, tick.start_ns);
}

void Service::ask_itself(std::int64_t tick_ns) {
  if (tick_ns < next_question_ns_) return;
  next_question_ns_ = tick_ns + nanoseconds(kAskEvery_s);
  const dds::SelfCheck before = std::exchange(itself_, endpoints_->ask_itself());
  if (itself_.address_gone && !before.address_gone)
    spdlog::error("event=address_gone why=\"this host no longer has an address that DDS listens on\"");
}

bool Service::is_deaf() const { return itself_.unanswered > kDeafAfter_s / kAskEvery_s; }

core::Arrivals Service::take_arrivals() {
  core::Arrivals arrivals = queue_.take();
  arrivals.counters.add(counters_);
  arrivals.counters.add(endpoints_->refused_datagrams());
  if (snapshots_) {
    const auto snapshots = snapshots_->totals();
    arrivals.counters.add("snapshots_written", snapshots.written);
    arrivals.counters.add("snapshots_failed", snapshots.failed);
  }
  return arrivals;
}

template <class T>
void Service::write(dds::Writer<T>& writer, const T& message) {
  const auto before = writer.left_out();
  if (!writer.write(message)) counters_.add("writes_failed");
  counters_.add("elements_left_out", writer.left_out() - before);
}

void Service::publish(const PublishedMap& map, const RoadMarkings& markings) {
  write(endpoints_->map, map);
  if (endpoints_->ros2) counters_.add("writes_failed", endpoints_->ros2->write(map));
  write(endpoints_->road_markings, markings);
}

void Service::publish(const ServiceStatus& status) {
  write(endpoints_->status, status);
  if (endpoints_->ros2) counters_.add("writes_failed", endpoints_->ros2->write(status));
}

void Service::log_tick(const core::Tick& tick, const core::Messages& messages) const {
  const PublishedMap& map = messages.map;
  if (messages.state_changed)
    spdlog::info("state={} session={}", state_text(map.state, map.reasons), map.session_id);
  // Benchmarks read this line to measure how long the map of a tick takes to its readers.
  if (!spdlog::should_log(spdlog::level::debug)) return;
  spdlog::debug("event=tick map={} start_ns={} delay_ns={} missed={}", map.sequence,
                system_now_ns() - (now_ns_() - tick.start_ns), tick.start_ns - tick.deadline_ns, tick.missed);
}

}  // namespace laneloom::service
