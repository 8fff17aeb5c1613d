// PNG files: pictures of throws, plots, the events in a recording.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace dodgesim {

// The bytes of the file. Throws IoError for a picture that is not of type CV_8UC1 (grey) or
// CV_8UC3 (BGR) or has no pixels.
std::string png_of(const cv::Mat& picture);

}  // namespace dodgesim
