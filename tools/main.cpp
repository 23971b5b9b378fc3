#include "commands/commands.hpp"
#include "commands/program.hpp"

int main(int argc, char** argv) {
  using namespace laneloom::commands;
  return run_program({.name = "laneloom",
                      .description = "laneloom: drives, watches, draws and rates the lane map service",
                      .commands = {add_publish, add_pnc, add_status, add_doctor, add_check, add_info, add_cut,
                                   add_record, add_replay, add_learn, add_import, add_export, add_view,
                                   add_render, add_evaluate, add_simulate, add_batch},
                      .other = "laneloom-lab",
                      .other_commands = {"experiment", "calibrate", "drive", "bench", "soak"}},
                     argc, argv);
}
