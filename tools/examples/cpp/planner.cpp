// planner DOMAIN VEHICLE_ID [straight|left|right]: says where the way of a wish leads on the lane map.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "laneloom/dds/reader.hpp"
#include "laneloom/element_names.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/state_names.hpp"
#include "laneloom/way.hpp"

namespace {

using laneloom::PublishedMap, laneloom::Way, laneloom::WayWish;

void say(const Way& way, const laneloom::Point& car) {
  const laneloom::WayPlace place = way.to_way(car);
  const laneloom::WayStation& here = way.stations.front();
  std::cout << "lane " << here.lane << ", " << here.width_m << " m wide; the car is " << place.d_m
            << " m left of its way, known for " << way.known_m << " m\n";
  if (here.may_change_left) std::cout << "  it may change to the left\n";
  for (const laneloom::WayLane& lane : way.lanes)
    std::cout << "  at " << lane.range.from_m << " m: lane " << lane.id << ", " << name(lane.entry) << '\n';
}

/// The way before is given each time, so that the way keeps to a branch that it has chosen.
void plan(const PublishedMap& published, WayWish wish, std::optional<Way>& way) {
  std::cout << laneloom::state_text(published.state, published.reasons) << '\n';
  // Neither by an old map, however good it was, nor by the maps of two services in turn.
  if (!laneloom::may_drive_on(published)) return void(std::cout << "no map to drive on\n");
  const laneloom::LaneGraph graph(published.map);
  const auto next = way_ahead(graph, published.map.T_map_body, wish, way ? &*way : nullptr);
  if (!next) return void(std::cout << "no lane here: on along the way before, ever slower\n");
  way = next;
  say(*way, published.map.T_map_body.translation());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: planner DOMAIN VEHICLE_ID [straight|left|right]\n", EXIT_FAILURE;
  laneloom::DdsConfig dds;
  dds.domain = std::atoi(argv[1]);
  dds.vehicle_id = argv[2];
  const std::string word = argc > 3 ? argv[3] : "straight";
  const WayWish wish = word == "left" ? WayWish::left : word == "right" ? WayWish::right : WayWish::straight;
  std::cout << std::unitbuf;
  std::mutex mutex;
  std::unique_ptr<PublishedMap> newest;  // a thread of DDS puts it there, and this one takes it
  const laneloom::dds::Participant participant(dds, "example of a planner");
  const laneloom::dds::Reader<PublishedMap> maps(
      participant, {.sample =
                        [&](PublishedMap&& map) {
                          const std::lock_guard lock(mutex);
                          newest = std::make_unique<PublishedMap>(std::move(map));
                        },
                    .refused = [](std::string_view why) { std::cerr << "refused: " << why << '\n'; }});
  std::optional<Way> way;
  for (int silent = 0;; std::this_thread::sleep_for(std::chrono::milliseconds(100))) {
    std::unique_ptr<PublishedMap> map;
    if (const std::lock_guard lock(mutex); newest) map.swap(newest);
    if (map) plan(*map, wish, way);
    silent = map ? 0 : silent + 1;
    if (silent == 3) std::cout << "no map came for 300 ms: stop\n";  // the service hangs, or is gone
  }
}
