#include "sim/campaign/result_files.h"

#include <optional>

#include "sim/campaign/campaign_files.h"
#include "sim/config/expand.h"
#include "sim/files/csv.h"
#include "sim/files/output_file.h"
#include "sim/outcome/blank_result.h"
#include "sim/tables/report.h"
#include "sim/tables/tables.h"

namespace dodgesim {

namespace {

namespace fs = std::filesystem;

// The files with rows of throws.
class RowFiles {
 public:
  RowFiles(const fs::path& out, const Scenario& scenario, bool truth)
      : throws_(out / kThrowsFile),
        objects_(out / kObjectsFile),
        detections_(out / kDetectionsFile),
        timing_(out / kTimingFile) {
    throws_.write(csv_header(blank_result(case_of(scenario, 0))));
    objects_.write(csv_header<ObjectRow>());
    detections_.write(csv_header<DetectionRow>());
    timing_.write("throw,simulated_s,wall_s,real_time_factor\n");
    if (!truth) return;
    truth_.emplace(out / kTruthFile);
    truth_->write(csv_header<EventTruthRow>());
  }

  void add(const ThrowResult& result) {
    throws_.write(csv_row(result));
    for (const ObjectRow& row : result.object_rows) objects_.write(csv_row(row));
    for (const DetectionRow& row : result.detection_rows) detections_.write(csv_row(row));
    const double simulated_s = seconds(result.duration_us);
    timing_.write(to_text(result.index) + "," + to_text(simulated_s) + "," +
                  to_text(result.wall_s) + "," +
                  (result.wall_s > 0 ? to_text(simulated_s / result.wall_s) : "") + "\n");
    if (!truth_) return;
    for (const EventTruthRow& row : result.truth_rows) truth_->write(csv_row(row));
  }

  // All or none: what the disk has no place for is known before the first is there.
  void commit() {
    std::vector<OutputFile*> files = {&throws_, &objects_, &detections_, &timing_};
    if (truth_) files.push_back(&*truth_);
    for (OutputFile* file : files) file->finish();
    for (OutputFile* file : files) file->commit();
  }

 private:
  OutputFile throws_, objects_, detections_, timing_;
  std::optional<OutputFile> truth_;
};

bool any_error(const ThrowResult& result) {
  return result.flown.failed() || result.none.failed() || result.oracle.failed();
}

}  // namespace

void write_result_files(const fs::path& out, const Scenario& scenario, const JournalIndex& index,
                        bool truth, CampaignSummary& summary) {
  RowFiles rows(out, scenario, truth);
  double simulated_s = 0, computing_s = 0;
  summary.truth.resize(static_cast<std::size_t>(sweep_count(scenario)));
  for_each_result(out / kJournalFile, index, [&](ThrowResult result) {
    rows.add(result);
    simulated_s += seconds(result.duration_us);
    computing_s += result.wall_s;
    if (any_error(result)) ++summary.errors;
    summary.truth.at(static_cast<std::size_t>(result.sweep)).add(result.truth_rows);
    result.drop_rows();
    summary.results.push_back(std::move(result));
  });
  if (computing_s > 0) summary.real_time_factor = simulated_s / computing_s;
  LoadedCampaign campaign =
      campaign_of(scenario, index.identity.program, std::move(summary.results));
  const Tables tables = make_tables(campaign);
  summary.table = tables.overview;
  rows.commit();
  write_file(out / kTableFile, tables.markdown);
  write_file(out / kTableCsvFile, tables.csv);
  write_file(out / kReportFile, report_html(campaign, out.string()));
  summary.results = std::move(campaign.results);
}

}  // namespace dodgesim
