// A small random video of its own for each test of dodgesim emulate.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/random.h"
#include "tests/cli/program.h"
#include "tests/sim/files/video_files.h"

namespace dodgesim::testing {

constexpr int kWidth = 19;
constexpr int kHeight = 7;
constexpr std::size_t kPixels = kWidth * kHeight;

struct Film {
  std::vector<std::int64_t> times;
  std::vector<float> luminance;
};

// Random walks of ln(I), steps and gentle slopes among them, at uneven instants.
inline Film random_film(std::size_t frames, std::int64_t start_us) {
  RandomStream random(4, 0, "film");
  Film film;
  std::vector<double> l(kPixels, -1);
  std::int64_t t_us = start_us;
  for (std::size_t n = 0; n < frames; ++n) {
    film.times.push_back(t_us);
    t_us += 1 + static_cast<std::int64_t>(random.uniform(0, 2500));
    for (double& value : l) {
      value += random.uniform() < 0.05 ? random.uniform(-3, 3) : random.uniform(-0.15, 0.15);
      value = std::clamp(value, -9.0, 3.0);
      film.luminance.push_back(static_cast<float>(std::exp(value)));
    }
  }
  return film;
}

class EmulateCommandTest : public ::testing::Test {
 protected:
  EmulateCommandTest() {
    write(film_);
    out_ = (root_ / "events.txt").string();
  }

  void write(const Film& film) const {
    put(root_ / "f.npy", npy_array("<f4", film.luminance, kHeight, kWidth));
    put(root_ / "t.npy", npy_array("<i8", film.times));
  }

  // With the files of the film, unless others are named.
  Outcome emulate(const std::string& options) const {
    return dodgesim("emulate " + (root_ / "f.npy").string() + " --timestamps " +
                    (root_ / "t.npy").string() + " " + options);
  }
  Outcome ideal() const { return emulate("--camera ideal --out " + out_); }

  TemporaryDirectory root_;
  const Film film_ = random_film(100, 1600000000000000);
  std::string out_;
};

}  // namespace dodgesim::testing
