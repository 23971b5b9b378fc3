// planner DOMAIN VEHICLE_ID [straight|left|right]: follows the lane map, and says which lane the car is in,
// where it may change lanes, and along which lanes the wished turn is made.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "laneloom/dds/reader.hpp"
#include "laneloom/lane_graph.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/state_names.hpp"

namespace {

using laneloom::PublishedMap, laneloom::Side, laneloom::Linkage;

constexpr double kReach_m = 60.0;

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

void plan(const PublishedMap& published, Linkage::Turn wished) {
  std::cout << laneloom::state_text(published.state, published.reasons) << '\n';
  // A planner must not drive on by an old map, however good it was.
  if (published.state == laneloom::MapState::stale) return;
  const laneloom::LaneGraph graph(published.map);
  const auto own = graph.own_lane(published.map.T_map_body);
  if (!own) return;
  std::cout << "in lane " << own->lane.lane->id << ", which is " << own->lane.lane->width_m << " m wide, "
            << own->offset_m << " m left of its center\n";
  for (const Side side : laneloom::kSides)
    if (const laneloom::Lane* beside = graph.beside(own->lane, side, own->arc_m))
      std::cout << (side == Side::left ? "  left" : "  right") << " of it is lane " << beside->id << '\n';
  for (const laneloom::Passage& passage : graph.ahead(own->lane, wished, own->arc_m + kReach_m))
    std::cout << "  the way leads " << (passage.turn == wished ? "as wished" : "on") << " into lane "
              << passage.to.lane->id << (passage.to.oncoming() ? ", against its traffic\n" : "\n");
  std::cout.flush();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::cerr << "usage: planner DOMAIN VEHICLE_ID [straight|left|right]\n", EXIT_FAILURE;
  laneloom::DdsConfig dds;
  dds.domain = std::atoi(argv[1]);
  dds.vehicle_id = argv[2];
  const std::string turn = argc > 3 ? argv[3] : "straight";
  const auto wished = turn == "left"    ? Linkage::Turn::left
                      : turn == "right" ? Linkage::Turn::right
                                        : Linkage::Turn::straight;
  Newest newest;
  const laneloom::dds::Participant participant(dds, "example of a planner");
  const laneloom::dds::Reader<PublishedMap> maps(
      participant, {.sample = [&newest](PublishedMap&& map) { newest.put(std::move(map)); },
                    .refused = [](std::string_view why) { std::cerr << "refused: " << why << '\n'; },
                    .alive = [](int services) { std::cerr << services << " services are alive\n"; }});
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(100)))
    if (const auto map = newest.take()) plan(*map, wished);
}
