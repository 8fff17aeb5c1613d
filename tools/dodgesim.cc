// The program `dodgesim`: a closed-loop simulator of a quadrotor that dodges thrown objects with
// event cameras.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "sim/base/error.h"
#include "sim/base/shell.h"
#include "sim/base/vector_level.h"
#include "sim/campaign/build_info.h"
#include "tools/commands/command.h"

namespace {

using namespace dodgesim;

std::string joined(int argc, char** argv) {
  std::string line = "dodgesim";
  for (int i = 1; i < argc; ++i) line += " " + shell_quoted(argv[i]);
  return line;
}

// Output that never reached its reader (a full disk behind a redirection) is no success.
int flushed(int exit_code) {
  std::cout.flush();
  const bool written = std::cout.good() && std::fflush(stdout) == 0;
  if (written) return exit_code;
  std::cerr << "dodgesim: the standard output could not be written.\n";
  return kIoError;
}

// The next file or pipe that is opened would take the number of a closed one. Writing to the output
// still fails.
void open_standard_files() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(fd, F_GETFD) >= 0) continue;
    if (::open("/dev/null", fd == STDERR_FILENO ? O_WRONLY : O_RDONLY) != fd) std::abort();
  }
}

bool is_command(CLI::App& program, const std::string& name) {
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == name) return true;
  }
  return false;
}

// The argument before an empty one, as a script makes it from a variable that was never set; CLI11
// would take the next argument for the value of "--option=".
std::string before_nothing(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.empty()) return argv[i - 1];
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1) {
      return argument.substr(0, argument.size() - 1);
    }
  }
  return "";
}

int no_such_command(CLI::App& program, const std::string& name) {
  std::cerr << "dodgesim has no command " << shell_quoted(name) << "; it has";
  const char* before = " ";
  for (const CLI::App* command : program.get_subcommands({})) {
    std::cerr << before << command->get_name();
    before = ", ";
  }
  std::cerr << ".\n";
  return kUsageError;
}

// Says what is wrong with the command line, or gives the help that was asked for.
int exit_of(const CLI::App& program, const CLI::ParseError& error) {
  return program.exit(error) == 0 ? kOk : kUsageError;
}

int run_program(int argc, char** argv) {
  CLI::App program(
      "dodgesim throws objects at a simulated quadrotor that sees them with event cameras, and\n"
      "counts how often it dodges. A scenario (YAML) says who throws what; see "
      "scenarios/README.md.",
      "dodgesim");
  program.footer(
      "A first flight:\n"
      "  dodgesim run scenarios/demo.yaml --out out/demo          fly 40 throws, print the table\n"
      "  dodgesim replay out/demo --throw 3 --video throw3.mp4    watch one of them\n"
      "Your own scenario:\n"
      "  cp scenarios/demo.yaml mine.yaml                         start from one that works\n"
      "  dodgesim explain throw                                   what can be thrown, and how\n"
      "  dodgesim validate mine.yaml                              every mistake, with its line\n"
      "Your own video:\n"
      "  dodgesim emulate v.npy --timestamps t.npy --camera ideal --out events.h5\n"
      "Your own recording:\n"
      "  dodgesim detect events.h5 --calibration camera.yaml --imu imu.csv --out out/detect\n\n"
      "Exit codes: 0 ok, 1 not as it should be (below the baseline, not as recorded, a check that\n"
      "fails), 2 usage or scenario error, 3 incomplete, 4 input/output error. \"dodgesim COMMAND "
      "--help\" says more.");
  program.require_subcommand(1);
  program.set_version_flag("--version", [] { return build_info().name(); });

  int exit_code = kOk;
  add_run_command(program, joined(argc, argv), exit_code);
  add_sweep_command(program, joined(argc, argv), exit_code);
  add_merge_command(program, joined(argc, argv), exit_code);
  add_compare_command(program, exit_code);
  add_gate_command(program, joined(argc, argv), exit_code);
  add_table_command(program, exit_code);
  add_report_command(program, exit_code);
  add_replay_command(program, exit_code);
  add_validate_command(program, exit_code);
  add_explain_command(program, exit_code);
  add_emulate_command(program, exit_code);
  add_detect_command(program, exit_code);
  add_bench_command(program, joined(argc, argv), exit_code);
  add_check_sensor_command(program, joined(argc, argv), exit_code);
  add_paper_command(program, joined(argc, argv), exit_code);
  if (argc > 1 && argv[1][0] != '-' && !is_command(program, argv[1])) {
    return no_such_command(program, argv[1]);
  }
  if (const std::string before = before_nothing(argc, argv); !before.empty()) {
    std::cerr << before << ": nothing was given\nRun with --help for more information.\n";
    return kUsageError;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    // What is missing may be what was misspelt.
    const std::vector<std::string> unknown = program.remaining(true);
    if (unknown.empty()) return exit_of(program, error);
    return exit_of(program, CLI::ExtrasError(program.get_name(), unknown));
  } catch (const CLI::ParseError& error) {
    return exit_of(program, error);
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_files();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing
  try {
    vector_level();  // a bad name is a mistake before all others
    return flushed(run_program(argc, argv));
  } catch (const ScenarioError& error) {
    std::cerr << error.what() << "\n";
    return kUsageError;
  } catch (const MissingThrows& error) {
    std::cerr << error.what() << "\n";
    return kIncomplete;
  } catch (const IoError& error) {
    std::cerr << error.what() << "\n";
    return kIoError;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << error.path1().string() << " could not be used: " << error.code().message()
              << ".\n";
    return kIoError;
  } catch (const std::bad_alloc&) {
    std::cerr << "dodgesim: there is not enough memory.\n";
    return kIncomplete;
  } catch (const std::exception& error) {
    std::cerr << "dodgesim: " << error.what() << "\n";
    return kIncomplete;
  }
}
