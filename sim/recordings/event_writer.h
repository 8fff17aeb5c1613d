// Recordings of events as files, in the formats that existing readers open.
//
// .h5   DSEC and RVT (HDF5): events/x u16, events/y u16, events/t u32 [us], events/p u8 (1 ON, 0
//       OFF), events/height, events/width; ms_to_idx u64, where ms_to_idx[ms] is the first i with
//       t[i] >= 1000 ms, of length t_last / 1000 + 1; t_offset i64, the instant of t = 0 [us].
//       gzip level 1 with shuffle, chunked; the same recording makes the same bytes.
// .npy  NumPy records t <i8 [us], x <u2, y <u2, p |i1 (+1 ON, -1 OFF).
// .txt  A line "t x y p" an event: t [us] as an integer, p 1 (ON) or 0 (OFF). The columns are
//       those of events.txt in the rpg data sets, where t is in seconds.
// .raw  Prophesee's EVT 2.0, which its programs open: a header, then words (evt_words.h). Its clock
//       counts from "% t_offset_us" in the header. Up to 2048 x 2048 px.
//
// t is the absolute time in .npy and .txt. A file appears only when it is whole
// (sim/files/staged_file.h).
//
// A recording with causes (sim/events/cause.h) says why each event happened: in events/cause u8
// (.h5), in a fifth field cause |u1 (.npy), in a fifth column (.txt); .raw has no place for it.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "sim/base/time.h"
#include "sim/events/cause.h"
#include "sim/events/event.h"

namespace dodgesim {

struct Recording {
  int width = 0;           // [px]
  int height = 0;          // [px]
  TimeUs t_offset_us = 0;  // the instant from which the events' time counts
  TimeUs duration_us = 0;  // no event is later
  bool has_causes = false;
};

// All functions throw IoError with the path and the reason when the file cannot be written.
class EventWriter {
 public:
  virtual ~EventWriter() = default;

  // Events in order of time, none before 0; t_us counts from Recording::t_offset_us. Memory stays
  // bounded. A recording with causes gets one an event, another none.
  virtual void add(std::span<const Event> events, std::span<const Cause> causes) = 0;
  void add(std::span<const Event> events) { add(events, {}); }

  // Flushes everything to the disk; what is left for commit() is to rename the file.
  virtual void finish() = 0;
  // The file appears. Without it nothing is left behind.
  virtual void commit() = 0;
};

// The format follows from the name's end. Throws ScenarioError for any other end, for a recording
// that is too long for .h5 (2^32 - 1 us, 71.6 minutes) or .raw (2^34 - 1 us, 4.7 hours), and for
// what .raw has no place for.
std::unique_ptr<EventWriter> make_event_writer(const std::filesystem::path& path,
                                               const Recording& recording);

}  // namespace dodgesim
