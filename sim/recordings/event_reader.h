// Reads recordings of events, a portion at a time, whatever their length.
//
// .h5   DSEC and RVT: events/x, y, t [us], p (0 or -1 OFF, 1 ON), and t_offset, if there is one,
//       which is added to t. Also with these four at the root, as the fields of records CD/events
//       (Prophesee) or events, as the columns t, x, y, p of a table events (v2e), or as xs, ys, ts
//       and ps (E2VID). t may be of real numbers: as in .txt, they are seconds if they have
//       fractions.
// .npy  Records with the fields t [us], x, y and p, little-endian integers or truths, in any order;
//       other little-endian numbers, texts and padding may stand between them.
// .txt  A line "t x y p" an event: t is in seconds, as in the rpg data sets, if it has a fraction
//       in one of the first 16,384 events, and otherwise in microseconds. A first line "width
//       height", as E2VID has, must be the size of the image.
// .csv  The same with commas, after a line that names the columns: t_us, x, y and p in any order.
// .raw  Prophesee's EVT 2.0 and EVT 3.0 (evt_words.h), behind lines "% keyword value" of which
//       "% format EVT3;height=720;width=1280" or "% evt 3.0" names the format. The clock is whole
//       however often it has wrapped; "% t_offset_us", which event_writer.h writes, is added to it.
//       Passed over are what stands before the first word of the clock, words of other kinds, and
//       one that is cut at the end of the file.
//
// Lines of .txt and .csv may be as text_columns.h has them. Columns and fields other than these,
// such as the causes of events, are passed over.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "sim/events/event.h"

namespace dodgesim {

struct ImageSize {
  int width = 0;   // [px]
  int height = 0;  // [px]
};

// All functions throw ScenarioError, one sentence that names the file and the line or event, for
// what is not as above and for pixels outside of the image, and IoError when reading fails.
class EventReader {
 public:
  virtual ~EventReader() = default;

  // The next events, in the order of the file, which need not be that of time; none at the end.
  // Valid until the next call.
  virtual std::span<const Event> next() = 0;

  // Whether its times have fractions and are therefore taken for seconds.
  virtual bool in_seconds() const { return false; }

  // How much of the file has been read, 0 to 1.
  virtual double part_read() const = 0;
};

// The format follows from the name's end.
std::unique_ptr<EventReader> open_events(const std::string& path, const ImageSize& image);

}  // namespace dodgesim
