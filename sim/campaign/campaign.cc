#include "sim/campaign/campaign.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "sim/campaign/progress.h"
#include "sim/campaign/running_campaign.h"
#include "sim/campaign/workers.h"
#include "sim/config/resolve_throw.h"

namespace dodgesim {

namespace {

// Campaigns one after the other, in the same workers.
class Fleet {
 public:
  Fleet(const std::vector<CampaignRun>& runs, const CampaignListener& listener)
      : runs_(runs), listener_(listener) {}

  WorkerMemory fly() {
    const CampaignOptions& options = runs_.front().options;
    WorkerTasks tasks;
    tasks.next = [this] { return next(); };
    tasks.jobs = options.jobs;
    tasks.limits = options.limits;
    tasks.fly = [this](const Task& task) { return run_of(task).fly(task.throw_index); };
    tasks.blank = [this](const Task& task) {
      return blank_result(case_of(run_of(task).scenario, task.throw_index));
    };
    tasks.receive = [this](const Task& task, const ThrowResult& result) { receive(task, result); };
    tasks.stop = [&] { return all_ended() || (options.stop && options.stop()); };
    const WorkerMemory memory = fly_in_workers(tasks);
    for (std::size_t i = 0; i < running_.size(); ++i) {
      if (running_[i]) end(i);  // somebody has stopped it
    }
    return memory;
  }

 private:
  const CampaignRun& run_of(const Task& task) const {
    return runs_[static_cast<std::size_t>(task.campaign)];
  }

  std::optional<Task> next() {
    while (true) {
      if (!running_.empty() && running_.back()) {
        if (const std::optional<int> index = running_.back()->next()) {
          return Task{static_cast<int>(running_.size()) - 1, *index};
        }
      }
      if (running_.size() == runs_.size()) return std::nullopt;
      begin();
    }
  }

  void begin() {
    const std::size_t i = running_.size();
    progress_.reset();
    if (listener_.begun) listener_.begun(i);
    running_.push_back(std::make_unique<RunningCampaign>(runs_[i].scenario, runs_[i].options));
    progress_.emplace(running_[i]->to_fly(), runs_[i].options.show_progress);
    if (running_[i]->over()) end(i);
  }

  void receive(const Task& task, const ThrowResult& result) {
    const auto i = static_cast<std::size_t>(task.campaign);
    if (!running_[i]) return;  // it has ended early
    running_[i]->add(result);
    if (i + 1 == running_.size()) progress_->show(running_[i]->flown());
    if (running_[i]->over()) end(i);
  }

  void end(std::size_t i) {
    CampaignSummary summary = running_[i]->finish();
    running_[i].reset();
    if (listener_.ended) listener_.ended(i, std::move(summary));
  }

  bool all_ended() const {
    return running_.size() == runs_.size() &&
           std::all_of(running_.begin(), running_.end(), [](const auto& r) { return !r; });
  }

  const std::vector<CampaignRun>& runs_;
  const CampaignListener& listener_;
  std::vector<std::unique_ptr<RunningCampaign>> running_;  // those that were begun; null: ended
  std::optional<Progress> progress_;                       // of the one that was begun last
};

ObjectRow as_drawn(const Throw& toss, int throw_index, int object) {
  ObjectRow row;
  row.throw_index = throw_index;
  row.object = object;
  row.kind = toss.object.kind;
  row.size_m = toss.object.size_m;
  row.speed_mps = toss.speed_mps;
  row.distance_m = toss.distance_m;
  row.bearing_deg = toss.bearing_deg;
  row.aim_offset_m = {toss.aim_offset_m.x(), toss.aim_offset_m.y()};
  row.spin_radps = {toss.spin_radps.x(), toss.spin_radps.y(), toss.spin_radps.z()};
  row.launch_height_m = toss.launch_height_m;
  row.launch_us = toss.launch_us;
  return row;
}

}  // namespace

ThrowResult blank_result(const ThrowCase& thrown) {
  ThrowResult result;
  result.index = thrown.index;
  result.cell = thrown.cell;
  result.sweep = thrown.sweep;
  result.cell_values = thrown.cell_values;
  result.sweep_values = thrown.sweep_values;
  for (const Throw& toss : resolve_throws(thrown.scenario, thrown.stream)) {
    result.object_rows.push_back(as_drawn(toss, thrown.index, result.objects++));
  }
  if (result.objects == 0) return result;
  const ObjectRow& first = result.object_rows.front();
  result.object = first.kind;
  result.size_m = first.size_m;
  result.speed_mps = first.speed_mps;
  result.distance_m = first.distance_m;
  result.bearing_deg = first.bearing_deg;
  result.aim_offset_m = first.aim_offset_m;
  result.spin_radps = first.spin_radps;
  result.launch_height_m = first.launch_height_m;
  result.launch_us = first.launch_us;
  return result;
}

CampaignSummary run_campaign(const Scenario& scenario, const CampaignOptions& options,
                             const FlyFunction& fly) {
  CampaignSummary summary;
  CampaignListener listener;
  listener.ended = [&](std::size_t /*i*/, CampaignSummary ended) { summary = std::move(ended); };
  const WorkerMemory memory = run_campaigns({{scenario, options, fly}}, listener);
  summary.memory = memory;
  return summary;
}

WorkerMemory run_campaigns(const std::vector<CampaignRun>& runs, const CampaignListener& listener) {
  if (runs.empty()) return {};
  return Fleet(runs, listener).fly();
}

}  // namespace dodgesim
