#include "endurance/watch.hpp"

#include <algorithm>
#include <string_view>
#include <thread>
#include <utility>

#include "pnc/report.hpp"

namespace laneloom::endurance {
namespace {

template <class Rises>
bool wait_until_it_rises(Rises count, std::chrono::seconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  const std::uint64_t before = count();
  while (count() == before) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace

Watch::Watch(const DdsConfig& dds)
    : participant_(dds, "laneloom-lab soak"),
      map_reader_(participant_, {.sample = [this](PublishedMap&& map) { take(std::move(map)); },
                                 .refused =
                                     [this](std::string_view reason) {
                                       const std::lock_guard lock(mutex_);
                                       maps_.violations.push_back("refused: " + std::string(reason));
                                     }}),
      status_reader_(participant_, {.sample = [this](ServiceStatus&& status) { take(std::move(status)); }}) {}

bool Watch::wait_for_good_map(std::chrono::seconds patience) const {
  const auto good_maps = [this] {
    const std::lock_guard lock(mutex_);
    return good_maps_;
  };
  return wait_until_it_rises(good_maps, patience);
}

bool Watch::wait_for_settled_status(std::chrono::seconds patience) const {
  const auto settled_statuses = [this] {
    const std::lock_guard lock(mutex_);
    return settled_statuses_;
  };
  return wait_until_it_rises(settled_statuses, patience);
}

std::map<std::uint64_t, Watch::Session> Watch::sessions() const {
  const std::lock_guard lock(mutex_);
  return sessions_;
}

Watch::Maps Watch::maps() const {
  const std::lock_guard lock(mutex_);
  return maps_;
}

void Watch::take(PublishedMap&& map) {
  pnc::PncUpdate update = pnc::judge(std::move(map), previous_ ? &*previous_ : nullptr);
  const std::lock_guard lock(mutex_);
  ++maps_.received;
  maps_.missed += update.missed;
  for (auto& violation : update.violations) maps_.violations.push_back(std::move(violation.detail));
  if (update.map.state == MapState::ok && !update.map.map.lanes.empty()) ++good_maps_;
  previous_ = std::move(update.map);
}

void Watch::take(ServiceStatus&& status) {
  const std::lock_guard lock(mutex_);
  Session& session = sessions_[status.session_id];
  for (const auto& source : status.sources) {
    const auto known =
        std::find_if(session.sources.begin(), session.sources.end(), [&](const SourceStatus& other) {
          return other.source == source.source && other.session_id == source.session_id;
        });
    if (known == session.sources.end()) {
      session.sources.push_back(source);
    } else {
      *known = source;
    }
  }
  if (status.pending_frames == 0 && status.detections_age_s > 1.0) ++settled_statuses_;
  session.last = std::move(status);
}

}  // namespace laneloom::endurance
