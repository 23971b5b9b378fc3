#include "ros2/listener.hpp"

#include <utility>

#include "ros2/input_readers.hpp"

namespace laneloom::ros2 {

class Listener::Impl : public InputReaders {
  using InputReaders::InputReaders;
};

Listener::Listener(const Config& config, const std::string& name, Inputs inputs)
    : impl_(std::make_unique<Impl>(make_participant(config.dds, name, dds::Participant::Presence::shown),
                                   config, std::move(inputs))) {}
Listener::~Listener() = default;

}  // namespace laneloom::ros2
