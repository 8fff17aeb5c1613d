#include "sim/flight/flight.h"

#include <algorithm>
#include <numbers>

#include "dodge/dodger.h"
#include "sim/base/error.h"
#include "sim/base/formatted.h"
#include "sim/base/gravity.h"
#include "sim/config/pilot.h"
#include "sim/flight/setup.h"
#include "sim/world/ray.h"

namespace dodgesim {

namespace {

constexpr TimeUs kShownBeforeUs = 100000;  // of the trajectory before the first launch

ImuSpec every_tick(ImuSpec spec) {
  spec.rate_hz = static_cast<int>(1000000 / kTickUs);
  return spec;
}

// An object that starts inside something would be pushed away by forces that no throw has.
void expect_free_launch(const World& world, std::size_t object) {
  const auto overlap = world.overlap(static_cast<int>(object));
  if (!overlap) return;
  throw SimulationError(
      formatted("Object %zu would be launched at %g s where it is %g m inside %s: change where "
                "(throw.distance_m, bearing_deg, launch_height_m) or when (launch_s, "
                "interval_s).",
                object, seconds(world.snapshot().t_us), overlap->depth_m, overlap->with.c_str()));
}

}  // namespace

Flight::Flight(const Scenario& scenario, const FlightPlan& plan, FlightObserver* observer)
    : scenario_(scenario),
      plan_(plan),
      world_(world_spec(scenario, plan.launches)),
      referee_(world_),
      motors_(scenario.motors, world_.vehicle().max_thrust_n),
      flight_controller_(scenario.flight_controller, world_.vehicle(), scenario.motors),
      controller_(scenario.controller, world_.vehicle()),
      imu_(scenario.sensors.imu, scenario.seed, index(), "imu"),
      flight_controller_imu_(every_tick(scenario.sensors.imu), scenario.seed, index(),
                             "flight_controller_imu"),
      state_estimator_(scenario.sensors.state_estimate, scenario.seed, index()),
      range_sensor_(scenario.sensors.range, scenario.seed, index()),
      computer_(scenario.delays, make_pilot()),
      flight_logger_(world_, flight_logger_setup()),
      observer_(observer != nullptr ? *observer : nobody_),
      rig_(make_rig()),
      mission_(scenario.mission),
      controller_states_(scenario.delays.state_estimate_us),
      rate_commands_(scenario.delays.link_us()),
      detection_logger_(world_, scenario.delays.pilot_us()) {
  const MissionSpec& mission = scenario.mission;
  const VehicleParameters& vehicle = world_.vehicle();
  world_.reset(mission.start_m, mission.heading_deg * std::numbers::pi / 180,
               Eigen::Vector3d::Zero());
  const double hover_n = 0.25 * vehicle.mass_kg * kGravityMps2;
  motors_.reset(0, {hover_n, hover_n, hover_n, hover_n});
  flight_controller_.reset({hover_n, hover_n, hover_n, hover_n});
  record_.command_delay_us = scenario.delays.link_us();
  rate_command_.thrust_mps2 = kGravityMps2;
  computer_.set_goal(mission_.goal());
  referee_.reset();
  observer_.on_start(computer_.pilot());
  if (!rig_) return;
  rig_->start();
  for (const auto& launch : plan_.launches) rig_->require(launch.drawn.launch_us);
}

std::uint64_t Flight::index() const { return static_cast<std::uint64_t>(plan_.throw_index); }

std::unique_ptr<dodge::Pilot> Flight::make_pilot() {
  if (perceives(plan_.pilot)) return make_seeing_pilot();
  const dodge::Config& core = scenario_.dodger;
  TruthPilot::Setup setup;
  setup.oracle = scenario_.oracle;
  setup.blind = plan_.pilot == kNoPilot;
  setup.delays = scenario_.delays;
  setup.latency_us = scenario_.sensors.events.latency_us;
  setup.lifetime_s = dodge::decay_lifetime_s(core.repulsive);
  for (const auto& launch : plan_.launches) setup.sizes_m.push_back(launch.drawn.object.size_m);
  setup.X_BC = world_.vehicle().X_BC.front();
  setup.intrinsics = intrinsics(scenario_.sensors.camera);
  auto pilot = std::make_unique<TruthPilot>(
      std::move(setup),
      dodge::Avoider(core.repulsive, core.attractive, core.velocity_limit, core.escape));
  truth_pilot_ = pilot.get();
  return pilot;
}

std::unique_ptr<dodge::Pilot> Flight::make_seeing_pilot() const {
  const dodge::Config config = core_config(scenario_, world_.vehicle());
  if (plan_.pilot != kPluginPilot) return std::make_unique<dodge::Dodger>(config);
  return make_plugin_pilot(scenario_.plugin, config, scenario_.plugin_parameters);
}

std::unique_ptr<EventRig> Flight::make_rig() const {
  if (truth_pilot_ != nullptr) return nullptr;
  EventRigSetup setup;
  setup.intrinsics = intrinsics(scenario_.sensors.camera);
  setup.render = scenario_.sensors.render;
  setup.keys = scenario_.sensors.keys;
  setup.events = scenario_.sensors.events;
  setup.sampling = scenario_.sensors.sampling;
  setup.packet_us = scenario_.delays.packet_us;
  setup.keep_causes = observer_.wants_causes();
  setup.cameras = cameras();
  setup.seed = scenario_.seed;
  setup.throw_index = index();
  return std::make_unique<EventRig>(world_, setup);
}

int Flight::cameras() const {
  return static_cast<int>(
      std::min(scenario_.dodger.position.cameras(), world_.vehicle().X_BC.size()));
}

FlightLogger::Setup Flight::flight_logger_setup() const {
  FlightLogger::Setup setup;
  setup.intrinsics = intrinsics(scenario_.sensors.camera);
  setup.cameras = cameras();
  // How far a pilot of one's own believes what it sees, nobody knows; others do not look.
  const bool known = perceives(plan_.pilot) && plan_.pilot != kPluginPilot;
  if (known) setup.near_m = scenario_.dodger.position.max_range_m;
  setup.end_us = plan_.end_us;
  if (plan_.launches.empty()) return setup;
  TimeUs first_us = plan_.end_us;
  for (const auto& launch : plan_.launches) first_us = std::min(first_us, launch.drawn.launch_us);
  setup.start_us = std::max<TimeUs>(0, first_us - kShownBeforeUs) / kTickUs * kTickUs;
  return setup;
}

bool Flight::over() const {
  const Verdict& verdict = referee_.verdict();
  return now_us() >= plan_.end_us || verdict.nearest.hit || verdict.crashed || verdict.landed;
}

void Flight::move() {
  const TimeUs start_us = now_us();
  bool launched = false;
  for (std::size_t i = 0; i < plan_.launches.size(); ++i) {
    if (plan_.launches[i].drawn.launch_us != start_us) continue;
    world_.launch(static_cast<int>(i), plan_.launches[i].state);
    expect_free_launch(world_, i);
    launched = true;
  }
  if (launched && rig_) rig_->rebase();
  before_ = world_.snapshot();
  world_.step(motors_.step(start_us));
  observer_.on_tick(world_);
}

void Flight::sense() {
  const Snapshot& now = world_.snapshot();
  gyro_B_radps_ = flight_controller_imu_.sample_gyro(now);
  // A pilot that knows the truth asks neither for the IMU nor for the range; a recording has both.
  const bool asked = truth_pilot_ == nullptr || &observer_ != &nobody_;
  if (asked && imu_.due(now.t_us)) {
    const ImuReading imu = imu_.sample(now);
    computer_.send_imu(imu);
    observer_.on_imu(imu);
  }
  if (state_estimator_.due(now.t_us)) {
    const StateReading state = state_estimator_.sample(now);
    computer_.send_state(state);
    controller_states_.push(now.t_us, state);
    observer_.on_state(state);
  }
  if (asked && range_sensor_.due(now.t_us)) {
    if (const auto reading = range_sensor_.sample(now.t_us, true_range_m())) {
      computer_.send_range(*reading);
      observer_.on_range(*reading);
    }
  }
}

void Flight::see() {
  const Snapshot& now = world_.snapshot();
  if (truth_pilot_ != nullptr) truth_pilot_->observe(now, state_estimator_.drift());
  if (!rig_) return;
  require_packet();
  rig_->advance(before_, now, [this](int camera, const Packet& packet) {
    computer_.send_events(camera, packet.end_us, packet.events);
    observer_.on_events(camera, packet);
  });
  detection_logger_.observe(now);
}

// The last packet that a cycle of the pilot will have must be complete by then. With a slow link
// that is not the next cycle but a later one.
void Flight::require_packet() {
  const DelaySpec& delays = scenario_.delays;
  TimeUs cycle_us = computer_.next_cycle_us();
  TimeUs end_us = 0;
  while (end_us <= before_.t_us) {
    end_us = delays.newest_packet_end_us(cycle_us);
    cycle_us += delays.period_us();
  }
  if (end_us <= now_us()) rig_->require(end_us);
}

void Flight::decide() {
  const auto start = WallClock::now();
  if (computer_.run_cycle(now_us())) note_cycle();
  if (const auto command = computer_.take_command(now_us())) {
    reference_ = {command->v_W, command->evading};
    evasion_arrived_ = command->evading;
    if (command->landing && !record_.landing_us) record_.landing_us = now_us();
    observer_.on_velocity(now_us(), *command);
  }
  pilot_s_ += seconds_since(start);
}

// The controller acts at each state estimate, and at once when it is to evade.
void Flight::control() {
  const TimeUs now = now_us();
  const auto act = [&] {
    rate_commands_.push(now, {controller_.update(*controller_state_, reference_), reference_});
    evasion_arrived_ = false;
  };
  controller_states_.deliver(now, [&](const StateReading& state) {
    if (mission_.update(state.p_W)) computer_.set_goal(mission_.goal());
    controller_state_ = state;
    act();
  });
  if (evasion_arrived_ && controller_state_) act();
  rate_commands_.deliver(now, [&](const SentCommand& sent) {
    rate_command_ = sent.command;
    const bool evading = sent.reference.evading;
    observer_.on_command(now, evading);
    if (evading && !record_.first_command_us) record_.first_command_us = now;
    flight_logger_.add_command(world_.snapshot(), sent.reference);
  });
  motors_.set_command(now, flight_controller_.step(now, rate_command_, gyro_B_radps_));
}

void Flight::judge() {
  detection_logger_.log_outputs(now_us(), [this](const DetectionRow& row, bool true_object) {
    flight_logger_.add_detection(row, true_object);
  });
  referee_.observe(world_, record_.landing_us.has_value());
  flight_logger_.observe(world_, reference_);
}

double Flight::true_range_m() const {
  const Eigen::Isometry3d X_WR = world_.snapshot().vehicle.pose() * world_.vehicle().X_BR;
  const Eigen::Vector3d down_W = X_WR.linear() * Eigen::Vector3d::UnitZ();
  const std::optional<RayHit> hit = surface_along(world_, X_WR.translation(), down_W);
  return hit ? hit->distance : std::numeric_limits<double>::infinity();
}

void Flight::note_cycle() {
  const dodge::Pilot& pilot = computer_.pilot();
  const Eigen::Vector3d& drift_W = state_estimator_.drift().p_W;
  if (detection_logger_.find(now_us(), pilot.detections(), drift_W)) {
    observer_.on_first_detection();
  }
  if (truth_pilot_ != nullptr) {  // it detects nothing: it is told
    for (const dodge::Obstacle& obstacle : truth_pilot_->obstacles()) {
      flight_logger_.add_told(obstacle.id, now_us() + scenario_.delays.pilot_us());
    }
  }
  observer_.on_cycle(now_us(), pilot);
}

FlightRecord Flight::record() const {
  FlightRecord record = record_;
  record.verdict = referee_.verdict();
  record.last = world_.snapshot();
  record.detections = detection_logger_.log();
  record.log = flight_logger_.log();
  record.agility = agility_of(world_.vehicle(), scenario_.motors);
  record.hull = referee_.hull();
  for (int i = 0; i < world_.object_count(); ++i) record.shapes.push_back(referee_.shape(i));
  if (rig_) {
    record.events = {rig_->event_count(0), rig_->event_count(1)};
    record.events_lost = {rig_->lost_count(0), rig_->lost_count(1)};
    record.events_hash = rig_->events_hash();
  }
  record.timing = timing();
  return record;
}

FlightTiming Flight::timing() const {
  FlightTiming timing;
  timing.total_s = seconds_since(constructed_);
  timing.pilot_s = pilot_s_;
  if (rig_) {
    timing.render_s = rig_->render_s();
    timing.emulate_s = rig_->emulate_s();
    timing.keys = rig_->keys();
    timing.pictures = rig_->pictures();
    timing.regions = rig_->regions();
  }
  return timing;
}

}  // namespace dodgesim
