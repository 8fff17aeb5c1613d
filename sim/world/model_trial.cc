#include "sim/world/model_trial.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <string>

#include "sim/base/error.h"
#include "sim/world/referee.h"
#include "sim/world/world.h"

namespace dodgesim {

namespace {

constexpr int kTicks = 40;

std::string files_of(const WorldSpec& spec) {
  std::string files = "rooms/" + spec.room + ".xml, vehicles/" + spec.vehicle + ".xml";
  for (const ObjectSpec& object : spec.objects) files += ", objects/" + object.kind + ".xml";
  return spec.models_dir + " (" + files + ")";
}

// What is wrong with the models, or nothing.
std::string complaint_about(const WorldSpec& spec, const TrialLimits& limits) {
  try {
    World world(spec);
    const Referee referee(world);
    for (int i = 0; i < world.object_count(); ++i) {
      BodyState state;
      state.p_W = Eigen::Vector3d(0, 0, 100 + 3 * i);
      world.launch(i, state);
    }
    for (int tick = 0; tick < kTicks; ++tick) world.step({});
  } catch (const std::bad_alloc&) {
    return "The models in " + files_of(spec) + " need more memory than " +
           std::to_string(limits.memory_mb) + " MB.";
  } catch (const ScenarioError& error) {
    return error.what();
  } catch (const std::exception& error) {
    return "The models in " + files_of(spec) + " cannot fly: " + error.what();
  }
  return "";
}

[[noreturn]] void serve(int fd, const WorldSpec& spec, const TrialLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const auto bytes = static_cast<rlim_t>(limits.memory_mb) << 20;
  const rlimit memory = {bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  const int nowhere = ::open("/dev/null", O_WRONLY);  // allocators and sanitizers print their own
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  const std::string complaint = complaint_about(spec, limits);
  const char good = complaint.empty() ? 1 : 0;
  const bool told = ::write(fd, &good, 1) == 1 && ::write(fd, complaint.data(), complaint.size()) ==
                                                      static_cast<ssize_t>(complaint.size());
  ::_exit(told ? 0 : 1);
}

// All that the child says until it ends; nothing if it takes too long.
bool listen_to(int fd, int wall_ms, std::string& said) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(wall_ms);
  std::array<char, 4096> buffer;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    pollfd polled = {fd, POLLIN, 0};
    const int ready = left.count() > 0 ? ::poll(&polled, 1, static_cast<int>(left.count())) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    said.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

void try_world(const WorldSpec& spec, const TrialLimits& limits) {
  int fds[2];
  if (::pipe2(fds, O_CLOEXEC) != 0) {
    throw SimulationError(std::string("A pipe could not be made: ") + std::strerror(errno) + ".");
  }
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(fds[0]);
    serve(fds[1], spec, limits);
  }
  const int error = errno;
  ::close(fds[1]);
  if (child < 0) {
    ::close(fds[0]);
    throw SimulationError(std::string("A process could not be made: ") + std::strerror(error) +
                          ".");
  }
  std::string said;
  const bool ended = listen_to(fds[0], limits.wall_ms, said);
  ::close(fds[0]);
  if (!ended) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::string subject = "The models in " + files_of(spec);
  if (!ended) {
    throw ScenarioError(subject + " take longer than " + std::to_string(limits.wall_ms / 1000) +
                        " s to load.");
  }
  if (said.empty()) {
    throw ScenarioError(subject +
                        " crash MuJoCo; a mesh whose faces name points that it does not "
                        "have is a common reason.");
  }
  if (said[0] == 0) throw ScenarioError(said.substr(1));
}

}  // namespace dodgesim
