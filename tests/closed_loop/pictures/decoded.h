// Pictures and videos as ffmpeg decodes them.
#pragma once

#include <opencv2/core.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/shell.h"
#include "tests/cli/program.h"

namespace dodgesim::testing {

// Colours: blue, green, red.
inline const cv::Vec3b kGrey(110, 110, 110), kWhite(255, 255, 255), kBlack(0, 0, 0);

// A file of one picture has one; one that ffmpeg cannot read has none.
inline std::vector<cv::Mat3b> decoded(const std::string& file) {
  std::istringstream ppm(shell("ffmpeg -v error -i " + shell_quoted(file) +
                               " -vsync passthrough -f image2pipe -c:v ppm -")
                             .output);
  std::vector<cv::Mat3b> pictures;
  std::string type;
  int width = 0, height = 0, white = 0;
  while (ppm >> type >> width >> height >> white && white == 255 && ppm.get() == '\n') {
    cv::Mat3b picture(height, width);
    if (!ppm.read(picture.ptr<char>(), static_cast<std::streamsize>(3 * picture.total()))) break;
    for (cv::Vec3b& pixel : picture) std::swap(pixel[0], pixel[2]);
    pictures.push_back(picture);
  }
  return pictures;
}

// Of a video; NaN if ffmpeg cannot read it.
inline double pictures_per_s(const std::string& file) {
  std::istringstream rate(
      shell("ffprobe -v error -show_entries stream=r_frame_rate -of csv=p=0 " + shell_quoted(file))
          .output);
  double pictures = 0, seconds = 0;
  char slash = 0;
  rate >> pictures >> slash >> seconds;
  return pictures / seconds;
}

}  // namespace dodgesim::testing
