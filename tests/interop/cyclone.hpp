#pragma once

#include <net/if.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "end_to_end/process.hpp"

namespace laneloom {

inline bool has_network() {
  bool found = false;
  struct if_nameindex* interfaces = if_nameindex();
  for (auto* i = interfaces; i && i->if_index != 0; ++i) found |= std::string_view(i->if_name) != "lo";
  if_freenameindex(interfaces);
  return found;
}

/// cyclone_participant with these arguments.
inline std::unique_ptr<Process> start_cyclone(std::vector<std::string> command) {
  // On a host without a network it would refuse the one interface that there is.
  if (!has_network())
    setenv("CYCLONEDDS_URI",
           R"(<General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces></General>)",
           0);
  return std::make_unique<Process>(command);
}

}  // namespace laneloom
