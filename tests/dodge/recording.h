// Real recordings as test inputs. They are not part of the project: tests skip without them.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "dodge/types.h"

namespace dodge::recording {

// The folder named by the environment variable DODGESIM_RECORDINGS, or the one beside the sources.
inline std::string path(const std::string& name) {
  const char* folder = std::getenv("DODGESIM_RECORDINGS");
  const std::string fallback = std::string(DODGESIM_SOURCE_DIR) + "/../shared/recordings";
  return (folder != nullptr ? std::string(folder) : fallback) + "/" + name;
}

// Events of a CSV with lines `t_us,x,y,p` (p 0 or 1) after a header; empty without the file. Events
// outside of the region of the given size at (left, top) are left out, the others moved to it.
inline std::vector<Event> read_events(const std::string& name, int width, int height, int left = 0,
                                      int top = 0) {
  std::vector<Event> events;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path(name).c_str(), "r"), [](std::FILE* f) { return std::fclose(f); });
  if (!file) return events;
  std::fscanf(file.get(), "%*s");
  long long t = 0;
  int x = 0, y = 0, p = 0;
  while (std::fscanf(file.get(), "%lld,%d,%d,%d", &t, &x, &y, &p) == 4) {
    x -= left;
    y -= top;
    if (x < 0 || y < 0 || x >= width || y >= height) continue;
    events.push_back({.t_us = t,
                      .x = static_cast<std::uint16_t>(x),
                      .y = static_cast<std::uint16_t>(y),
                      .polarity = static_cast<std::int8_t>(p > 0 ? 1 : -1)});
  }
  return events;
}

}  // namespace dodge::recording
