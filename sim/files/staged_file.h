// A file that is either whole or absent: made under the temporary name PATH.partial, flushed to the
// disk, and only then renamed.
#pragma once

#include <filesystem>
#include <string>

#include "sim/base/descriptor.h"

namespace dodgesim {

class StagedFile {
 public:
  // Creates PATH.partial, empty; PATH is followed if it is a link, and refused if it is a device, a
  // pipe or a directory, or if another program is writing to it. All functions throw IoError with
  // the path and the reason.
  explicit StagedFile(std::filesystem::path path);
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  ~StagedFile();  // without commit() the temporary file is removed

  // PATH or, if it is a link, its target, which need not exist.
  static std::filesystem::path target(const std::filesystem::path& path);
  // The temporary name of PATH, which is no link.
  static std::filesystem::path partial_name(const std::filesystem::path& path) {
    return path.string() + ".partial";
  }

  const std::filesystem::path& path() const { return path_; }  // target(PATH)
  const std::filesystem::path& partial() const { return partial_; }
  int fd() const { return file_.get(); }  // open for writing until commit()

  // Waits until the disk has the contents.
  void sync();
  // The same, then renames the file to path().
  void commit();

  // Throws IoError "PATH <what>: <reason>." with the text of `error_number`, or without a reason
  // when it is 0.
  [[noreturn]] void fail(const std::string& what, int error_number) const;

 private:
  void lock();

  std::filesystem::path path_, partial_;
  Descriptor file_;
};

}  // namespace dodgesim
