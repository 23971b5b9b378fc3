#pragma once

namespace CLI {
class App;
}

/// The subcommands of `laneloom-lab`, registered as those in commands.hpp.
namespace laneloom::commands {

void add_experiment(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_drive(CLI::App& app);
void add_bench(CLI::App& app);
void add_soak(CLI::App& app);

}  // namespace laneloom::commands
