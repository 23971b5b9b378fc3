#include "bench/latency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <unordered_map>

#include "base/clock.hpp"
#include "bench/process_usage.hpp"
#include "bench/view_readers.hpp"
#include "io/work_folder.hpp"
#include "laneloom/dds/reader.hpp"
#include "support/child_process.hpp"
#include "support/publication_log.hpp"
#include "support/stage_timer.hpp"

namespace laneloom::bench {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{15};
constexpr std::chrono::seconds kSettling{2};  // wait after the first map, for discovery and the first lines

double milliseconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) * 1e-6; }

/// The planning participant. Keeps the time at which each map came.
class MapListener {
 public:
  explicit MapListener(const DdsConfig& dds)
      : participant_(dds, "laneloom-lab bench"),
        reader_(participant_, {.sample = [this](PublishedMap&& map) { take(map); }}) {}

  std::vector<ReceivedMap> maps() const {
    const std::lock_guard lock(mutex_);
    return maps_;
  }
  bool has_fused() const {
    const std::lock_guard lock(mutex_);
    return !maps_.empty() && !maps_.back().fused_frames.empty();
  }

 private:
  void take(const PublishedMap& map) {
    ReceivedMap received{map.sequence, map.published_ns, system_now_ns(), {}};
    received.fused_frames.reserve(map.fused_frames.size());
    for (const FusedFrame& frame : map.fused_frames) received.fused_frames.push_back(frame.sequence);
    const std::lock_guard lock(mutex_);
    maps_.push_back(std::move(received));
  }

  mutable std::mutex mutex_;
  std::vector<ReceivedMap> maps_;
  dds::Participant participant_;
  dds::Reader<PublishedMap> reader_;  // last, because it calls into the members above
};

/// Keeps cores busy while it lives.
class BusyThreads {
 public:
  explicit BusyThreads(unsigned count) {
    threads_.reserve(count);
    for (unsigned i = 0; i < count; ++i) {
      threads_.emplace_back([](const std::stop_token& stopped) {
        while (!stopped.stop_requested()) {
        }
      });
    }
  }

 private:
  std::vector<std::jthread> threads_;
};

/// A program of the measurement. If it ends by itself, the error quotes the end of its log.
class Party {
 public:
  Party(std::vector<std::string> command, std::string log)
      : name_(command.front()), log_(std::move(log)), process_(std::move(command), log_) {}

  void check() {
    if (!process_.running()) fail("ended by itself");
  }
  void stop() {
    const std::string failure = process_.stop();
    if (!failure.empty()) fail(failure);
  }
  pid_t id() const { return process_.id(); }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    std::ostringstream words;
    words << std::ifstream(log_).rdbuf();
    throw std::runtime_error(name_ + ": " + what + ": " + words.str());
  }

  std::string name_, log_;
  support::ChildProcess process_;
};

DdsConfig dds_of(const LatencySpec& spec, const char* identity) {
  DdsConfig dds = spec.dds;
  if (!spec.identities.empty()) dds.security_directory = spec.identities / identity;
  return dds;
}

void write_config(const std::string& file, const DdsConfig& dds) {
  std::ofstream out(file);
  out << "service:\n  log_level: debug\ndds:\n  domain: " << dds.domain << "\n  vehicle_id: '"
      << dds.vehicle_id << "'\n  transport: " << dds.transport << "\n  security_directory: '"
      << dds.security_directory << "'\n";
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

std::vector<std::string> publish_command(const LatencySpec& spec, const std::string& times) {
  return {spec.publisher.string(),
          "publish",
          "--scenario",
          spec.scenario,
          "--noise",
          spec.noise,
          "--speed",
          fmt::format("{}", spec.speed_mps),
          "--delay-spread",
          fmt::format("{}", spec.delay_spread_ms),
          "--loop",
          "--domain",
          std::to_string(spec.dds.domain),
          "--vehicle-id",
          spec.dds.vehicle_id,
          "--security",
          dds_of(spec, "simulator").security_directory,
          "--wait-for-readers",
          "1",
          "--times",
          times};
}

void wait_for_maps(const MapListener& listener, Party& service, Party& publisher) {
  const auto deadline = SteadyClock::now() + kPatience;
  while (!listener.has_fused()) {
    service.check();
    publisher.check();
    if (SteadyClock::now() > deadline) throw std::runtime_error("no map came");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::this_thread::sleep_for(kSettling);
}

/// `laneloom view` with its readers.
class WatchedViewer {
 public:
  WatchedViewer(const LatencySpec& spec, const std::string& log)
      : process_(
            {spec.publisher.string(), "view", "--port", "0", "--domain", std::to_string(spec.dds.domain),
             "--vehicle-id", spec.dds.vehicle_id, "--security", dds_of(spec, "observer").security_directory},
            log),
        readers_(port_in(log), spec.viewers),
        viewers_(static_cast<double>(spec.viewers)) {}

  void begin() {
    cpu_before_s_ = cpu_s(process_.id());
    frames_before_ = readers_.frames();
    begin_ = SteadyClock::now();
  }
  ViewerCost end() {
    process_.check();
    const std::chrono::duration<double> elapsed = SteadyClock::now() - begin_;
    const auto frames = static_cast<double>(readers_.frames() - frames_before_);
    return {.cpu_percent = 100.0 * (cpu_s(process_.id()) - cpu_before_s_) / elapsed.count(),
            .peak_rss_mb = peak_rss_mb(process_.id()),
            .frames_per_s = frames / viewers_ / elapsed.count()};
  }

 private:
  /// The port of the URL that the viewer prints.
  std::uint16_t port_in(const std::string& log) {
    const auto deadline = SteadyClock::now() + kPatience;
    for (;;) {
      unsigned port = 0;
      std::string line;
      if (std::getline(std::ifstream(log) >> std::ws, line) &&
          std::sscanf(line.c_str(), "http://127.0.0.1:%u/", &port) == 1)
        return static_cast<std::uint16_t>(port);
      process_.check();
      if (SteadyClock::now() > deadline) throw std::runtime_error("laneloom view printed no URL");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  Party process_;
  ViewReaders readers_;
  double viewers_;
  double cpu_before_s_ = 0.0;
  std::uint64_t frames_before_ = 0;
  SteadyClock::time_point begin_;
};

/// The ticks that began from `from_ns` to `to_ns`.
std::vector<LoggedTick> ticks_between(std::vector<LoggedTick> ticks, std::int64_t from_ns,
                                      std::int64_t to_ns) {
  std::erase_if(ticks,
                [&](const LoggedTick& tick) { return tick.start_ns < from_ns || tick.start_ns > to_ns; });
  return ticks;
}

}  // namespace

LatencyResult latencies(const std::vector<LoggedTick>& ticks, const std::vector<ReceivedMap>& maps,
                        const std::map<std::uint64_t, std::int64_t>& published) {
  std::unordered_map<std::uint64_t, const ReceivedMap*> by_sequence;
  for (const ReceivedMap& map : maps) by_sequence.emplace(map.sequence, &map);
  LatencyResult result;
  std::vector<double> delay_ms, tick_ms, publication_ms, detections_ms;
  for (const LoggedTick& tick : ticks) {
    ++result.ticks;
    result.missed_deadlines += tick.missed;
    delay_ms.push_back(milliseconds(tick.delay_ns));
    const auto found = by_sequence.find(tick.map);
    if (found == by_sequence.end()) {
      ++result.maps_lost;
      continue;
    }
    const ReceivedMap& map = *found->second;
    tick_ms.push_back(milliseconds(map.callback_ns - tick.start_ns));
    publication_ms.push_back(milliseconds(map.callback_ns - map.published_ns));
    for (const std::uint64_t frame : map.fused_frames) {
      const auto at = published.find(frame);
      if (at != published.end()) detections_ms.push_back(milliseconds(map.callback_ns - at->second));
    }
  }
  result.frames = detections_ms.size();
  result.tick_delay = support::summarise(std::move(delay_ms));
  result.tick_to_callback = support::summarise(std::move(tick_ms));
  result.publication_to_callback = support::summarise(std::move(publication_ms));
  result.detections_to_callback = support::summarise(std::move(detections_ms));
  return result;
}

LatencyResult measure_latency(const LatencySpec& spec) {
  const io::WorkFolder folder;
  const std::string config = folder.file("laneloomd.yaml"), times = folder.file("times.csv"),
                    log = folder.file("laneloomd.log");
  write_config(config, dds_of(spec, "service"));
  MapListener listener(dds_of(spec, "pnc"));
  Party service({spec.service.string(), "--config", config}, log);
  Party publisher(publish_command(spec, times), folder.file("publish.log"));
  std::optional<WatchedViewer> viewer;
  if (spec.viewers > 0) viewer.emplace(spec, folder.file("view.log"));
  wait_for_maps(listener, service, publisher);

  const pid_t id = service.id();
  const double cpu_before_s = cpu_s(id);
  const std::int64_t from_ns = system_now_ns();
  if (viewer) viewer->begin();
  {
    const BusyThreads load(spec.busy_threads);
    std::this_thread::sleep_for(std::chrono::duration<double>(spec.duration_s));
  }
  service.check();
  publisher.check();
  const std::int64_t to_ns = system_now_ns();
  const auto viewer_cost = viewer ? std::optional(viewer->end()) : std::nullopt;
  const double cpu_used_s = cpu_s(id) - cpu_before_s;
  const double peak_mb = peak_rss_mb(id);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // for the last map, which is on its way
  publisher.stop();
  service.stop();

  LatencyResult result = latencies(ticks_between(read_tick_log(log), from_ns, to_ns), listener.maps(),
                                   support::read_publication_log(times).times_ns);
  result.service_cpu_percent = 100.0 * cpu_used_s / (static_cast<double>(to_ns - from_ns) * 1e-9);
  result.service_peak_rss_mb = peak_mb;
  result.viewer = viewer_cost;
  return result;
}

}  // namespace laneloom::bench
