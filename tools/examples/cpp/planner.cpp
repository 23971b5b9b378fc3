// planner DOMAIN VEHICLE_ID: follows the lane map, and says which lane the car is in.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <mutex>
#include <thread>

#include "laneloom/dds/reader.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/state_names.hpp"

namespace {

using laneloom::Lane;
using laneloom::PublishedMap;

/// The newest map, which a thread of DDS puts there and the planner's thread takes.
class Newest {
 public:
  void put(PublishedMap&& map) {
    const std::lock_guard lock(mutex_);
    map_ = std::make_unique<PublishedMap>(std::move(map));
  }
  std::unique_ptr<PublishedMap> take() {
    const std::lock_guard lock(mutex_);
    return std::move(map_);
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<PublishedMap> map_;
};

/// Of a lane that has the car between its borders; negative: there is none.
double metres_left_of_right_border(const Lane& lane, const Eigen::Isometry3d& T_body_map) {
  for (std::size_t i = 0; i + 1 < lane.left.size() && i + 1 < lane.right.size(); ++i) {
    const laneloom::Point left = T_body_map * lane.left[i], right = T_body_map * lane.right[i];
    const double ahead = (T_body_map * lane.left[i + 1]).x();
    if (left.x() <= 0.0 && ahead >= 0.0 && left.y() > 0.0 && right.y() < 0.0) return -right.y();
  }
  return -1.0;
}

void plan(const PublishedMap& published) {
  std::cout << laneloom::state_text(published.state, published.reasons);
  // A planner must not drive on by an old map, however good it was.
  if (published.state == laneloom::MapState::stale) {
    std::cout << ": no map to drive on\n";
    return;
  }
  std::cout << ", " << published.map.lanes.size() << " lanes\n";
  for (const Lane& lane : published.map.lanes) {
    const double offset_m = metres_left_of_right_border(lane, published.map.T_map_body.inverse());
    if (offset_m < 0.0) continue;
    std::cout << "in lane " << lane.id << ", which is " << lane.width_m << " m wide, " << offset_m
              << " m left of its right border\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::cerr << "usage: planner DOMAIN VEHICLE_ID\n", EXIT_FAILURE;
  laneloom::DdsConfig dds;
  dds.domain = std::atoi(argv[1]);
  dds.vehicle_id = argv[2];
  Newest newest;
  const laneloom::dds::Participant participant(dds, "example of a planner");
  const laneloom::dds::Reader<PublishedMap> maps(
      participant,
      {.sample = [&newest](PublishedMap&& map) { newest.put(std::move(map)); },
       .refused = [](std::string_view why) { std::cerr << "a map was refused: " << why << '\n'; },
       .alive = [](int services) { std::cerr << services << " services are alive\n"; }});
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(100)))
    if (const auto map = newest.take()) plan(*map);
}
