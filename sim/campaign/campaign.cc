#include "sim/campaign/campaign.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

#include "sim/base/error.h"
#include "sim/base/progress.h"
#include "sim/campaign/running_campaign.h"
#include "sim/campaign/workers.h"
#include "sim/outcome/blank_result.h"

namespace dodgesim {

namespace {

// The lock is the process's: it would not keep two campaigns of one process apart.
void expect_different_directories(const std::vector<PlannedCampaign>& plans) {
  std::set<std::filesystem::path> directories;
  for (const PlannedCampaign& plan : plans) {
    const std::filesystem::path& out = plan.options.out;
    std::error_code error;  // what cannot be, make_directory() refuses
    const auto where = std::filesystem::weakly_canonical(out, error);
    if (error || directories.insert(where).second) continue;
    throw ScenarioError("Two campaigns would write to " + out.string() + ".");
  }
}

// Campaigns one after the other, in the same workers.
class CampaignQueue {
 public:
  CampaignQueue(const std::vector<PlannedCampaign>& plans, const CampaignListener& listener)
      : plans_(plans), listener_(listener) {
    expect_different_directories(plans);
    for (const PlannedCampaign& plan : plans) {
      campaigns_.push_back(std::make_unique<RunningCampaign>(*plan.scenario, plan.options));
    }
    for (const auto& campaign : campaigns_) campaign->prepare();
  }

  WorkerMemory fly() {
    const CampaignOptions& options = plans_.front().options;
    WorkerTasks tasks;
    tasks.next = [this] { return next(); };
    tasks.jobs = options.jobs;
    tasks.limits = options.limits;
    tasks.fly = [this](const Task& task) { return plan_of(task).fly(task.throw_index); };
    tasks.blank = [this](const Task& task) {
      return blank_result(case_of(*plan_of(task).scenario, task.throw_index));
    };
    tasks.receive = [this](const Task& task, const ThrowResult& result) { receive(task, result); };
    tasks.meanwhile = [this] { end_those_over(); };
    tasks.stop = [&] { return all_ended() || (options.stop && options.stop()); };
    const WorkerMemory memory = fly_in_workers(tasks);
    for (std::size_t i = 0; i < begun_; ++i) {
      if (campaigns_[i]) end(i);  // also what somebody has stopped
    }
    return memory;
  }

 private:
  const PlannedCampaign& plan_of(const Task& task) const {
    return plans_[static_cast<std::size_t>(task.campaign)];
  }

  std::optional<Task> next() {
    while (true) {
      if (begun_ > 0 && campaigns_[begun_ - 1]) {
        if (const std::optional<int> index = campaigns_[begun_ - 1]->next()) {
          return Task{static_cast<int>(begun_) - 1, *index};
        }
      }
      if (begun_ == campaigns_.size()) return std::nullopt;
      begin();
    }
  }

  void begin() {
    const std::size_t i = begun_++;
    progress_.reset();
    if (listener_.begun) listener_.begun(i);
    campaigns_[i]->begin();
    progress_.emplace(campaigns_[i]->to_fly(), "throws", plans_[i].options.show_progress);
  }

  void receive(const Task& task, const ThrowResult& result) {
    const auto i = static_cast<std::size_t>(task.campaign);
    if (!campaigns_[i]) return;  // it has ended early
    campaigns_[i]->add(result);
    if (i + 1 == begun_) progress_->show(campaigns_[i]->flown());
  }

  void end_those_over() {
    for (std::size_t i = 0; i < begun_; ++i) {
      if (campaigns_[i] && campaigns_[i]->over()) end(i);
    }
  }

  void end(std::size_t i) {
    CampaignSummary summary = campaigns_[i]->finish();
    campaigns_[i].reset();
    if (listener_.ended) listener_.ended(i, std::move(summary));
  }

  bool all_ended() const {
    return std::ranges::all_of(campaigns_, [](const auto& c) { return !c; });
  }

  const std::vector<PlannedCampaign>& plans_;
  const CampaignListener& listener_;
  std::vector<std::unique_ptr<RunningCampaign>> campaigns_;  // null: ended
  std::size_t begun_ = 0;                                    // so many of them
  std::optional<Progress> progress_;                         // of the one that was begun last
};

}  // namespace

CampaignSummary run_campaign(const Scenario& scenario, const CampaignOptions& options,
                             const FlyFunction& fly) {
  CampaignSummary summary;
  CampaignListener listener;
  listener.ended = [&](std::size_t /*i*/, CampaignSummary ended) { summary = std::move(ended); };
  const WorkerMemory memory = run_campaigns({{&scenario, options, fly}}, listener);
  summary.memory = memory;
  return summary;
}

WorkerMemory run_campaigns(const std::vector<PlannedCampaign>& plans,
                           const CampaignListener& listener) {
  if (plans.empty()) return {};
  return CampaignQueue(plans, listener).fly();
}

}  // namespace dodgesim
