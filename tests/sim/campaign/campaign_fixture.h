// A scenario of twelve throws that are not flown but made up, in a directory of its own.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "sim/campaign/campaign.h"
#include "sim/outcome/blank_result.h"
#include "tests/sim/files/temporary_directory.h"
#include "tests/sim/tables/fake_throws.h"

namespace dodgesim {

class CampaignTest : public ::testing::Test {
 protected:
  CampaignTest() {
    scenario_ = parse_scenario(
        "seed: 4\nrepeats: 12\nthrow: {size_m: !choice [0.1, 0.2], distance_m: !uniform [2, 5]}\n",
        "fake.yaml", "");
  }

  CampaignOptions options(const std::string& name, int jobs = 1) const {
    CampaignOptions options;
    options.out = root_ / name;
    options.jobs = jobs;
    return options;
  }

  // A throw whose result depends on its number alone; the first ones take longest, so that workers
  // finish out of order.
  ThrowResult fly(int index) const {
    std::this_thread::sleep_for(std::chrono::milliseconds(index < 3 ? 30 : 1));
    ThrowResult result = blank_result(case_of(scenario_, index));
    result.flown = flown(index % 3 == 0);
    result.none = flown(true);
    result.duration_us = 2000000;
    result.detection_rows.resize(static_cast<std::size_t>(index));
    for (DetectionRow& row : result.detection_rows) row.throw_index = index;
    return result;
  }

  const testing::TemporaryDirectory directory_;
  const std::filesystem::path root_ = directory_.path();
  Scenario scenario_;
};

// The files that are the same for the same results.
inline const char* const kReproducible[] = {"scenario.resolved.yaml", "throws.csv", "objects.csv",
                                            "detections.csv",         "table.md",   "table.csv"};

}  // namespace dodgesim
