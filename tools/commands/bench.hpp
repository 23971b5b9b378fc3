#pragma once

namespace CLI {
class App;
}

namespace laneloom::commands {

/// Subcommands of `laneloom-lab bench`, registered as those in commands.hpp.
void add_bench_latency(CLI::App& bench);
void add_bench_scale(CLI::App& bench);
void add_bench_worst(CLI::App& bench);

}  // namespace laneloom::commands
