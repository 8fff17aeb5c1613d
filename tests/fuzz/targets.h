// Readers of files that come from outside, as functions of arbitrary bytes: what is not as it
// should be is refused with an exception of ours, and what is accepted is what was written. They
// abort when a reader breaks that promise; libFuzzer looks for bytes that make them (tools/fuzz),
// and corpus_test.cc runs them on the bytes that it once found.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>

namespace dodgesim::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Target {
  const char* name;
  bool (*run)(Bytes bytes);  // whether the reader accepted them
};

bool scenario(Bytes bytes);  // parse_scenario, to_yaml
bool camera(Bytes bytes);    // the file of an event camera
bool journal(Bytes bytes);   // results.bin: the whole file, or (first byte odd) records in it
bool result(Bytes bytes);    // a result and a campaign's identity from a worker or the journal
bool csv(Bytes bytes);       // throws.csv of a baseline
bool manifest(Bytes bytes);  // manifest.json of a baseline
bool npy(Bytes bytes);       // frames and time stamps of a video
bool mesh(Bytes bytes);      // an OBJ file
bool events(Bytes bytes);    // recordings of events, of an IMU and of states

// Names a target in the messages of tests.
inline std::ostream& operator<<(std::ostream& out, const Target& target) {
  return out << target.name;
}

inline constexpr Target kTargets[] = {
    {"scenario", scenario}, {"camera", camera}, {"journal", journal},
    {"result", result},     {"csv", csv},       {"manifest", manifest},
    {"npy", npy},           {"events", events}, {"mesh", mesh},
};

}  // namespace dodgesim::fuzz
