#pragma once

namespace CLI {
class App;
}

/// The subcommands of `laneloom`, one file each. Each function registers its command; the command's work is
/// done while the command line is parsed. It throws std::exception if it failed, which run_program() reports,
/// and calls end_with() (exit_codes.hpp) for any other exit code.
namespace laneloom::commands {

void add_batch(CLI::App& app);
void add_publish(CLI::App& app);
void add_pnc(CLI::App& app);
void add_status(CLI::App& app);
void add_check(CLI::App& app);
void add_cut(CLI::App& app);
void add_doctor(CLI::App& app);
void add_render(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_simulate(CLI::App& app);
void add_replay(CLI::App& app);
void add_info(CLI::App& app);
void add_learn(CLI::App& app);
void add_record(CLI::App& app);
void add_export(CLI::App& app);
void add_import(CLI::App& app);
void add_import_frames(CLI::App& import);  ///< below `import`, as the next
void add_import_scene(CLI::App& import);
void add_view(CLI::App& app);

}  // namespace laneloom::commands
