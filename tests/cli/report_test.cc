// The report of a campaign, opened in a browser as its readers open it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/command_test.h"
#include "tests/models.h"

namespace {

namespace fs = std::filesystem;
using dodgesim::testing::CommandTest;
using dodgesim::testing::copy_models;
using dodgesim::testing::dodgesim;
using dodgesim::testing::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Physics only, so that it takes no time: a throw each that is dodged, that hits and that misses.
constexpr const char* kScenario = R"(
name: a campaign
seed: 3
repeats: 4
pilot: oracle
fly_oracle: false
mission: {start_m: [-2, 0, 2]}
throw: {size_m: !choice [0.2, 0.3], distance_m: 3, speed_mps: !uniform [4, 9], launch_s: 0.3}
after_s: 0.2
)";

class ReportCommandTest : public CommandTest {
 protected:
  ReportCommandTest() { write("s.yaml", kScenario); }

  void fly() const {
    const Outcome outcome = dodgesim("run " + path("s.yaml") + " -j 1 --out " + path("out"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }

  // The page as it stands after its program has run, with what the browser said about it.
  Outcome browse(const std::string& page, int width_px = 1200) const {
    return dodgesim::testing::shell(
        "HOME=" + root_.string() +
        " timeout 60 chromium-headless-shell --no-sandbox --disable-gpu --enable-logging=stderr "
        "--window-size=" +
        std::to_string(width_px) + ",900 --dump-dom 'file://" + page + "'");
  }
};

TEST_F(ReportCommandTest, APageOpensWithoutErrorsAndShowsChartsAndAThrow) {
  fly();
  const Outcome outcome = browse(path("out/report.html") + "#throw=2");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string& dom = outcome.output;
  EXPECT_THAT(dom, Not(HasSubstr(":CONSOLE:"))) << dom.substr(0, 4000);
  EXPECT_THAT(dom, HasSubstr("data-ready=\"true\""));
  EXPECT_THAT(dom, HasSubstr("<h1 id=\"title\">a campaign</h1>"));
  EXPECT_THAT(dom, HasSubstr("class=\"cell\" role=\"button\""));  // the heat map
  EXPECT_THAT(dom, HasSubstr("class=\"band\""));                  // a curve with its band
  EXPECT_THAT(dom, HasSubstr("class=\"bar\""));                   // a histogram
  EXPECT_THAT(dom, HasSubstr(">speed [m/s]; a point stands for a bin, such as 4 to 5</text>"));
  EXPECT_THAT(dom, HasSubstr("at most one in 10 ms is drawn, in a flight of more than 5 s\nfewer; "
                             "detections.csv has all."));
  EXPECT_THAT(dom, HasSubstr("<h2 id=\"throw-title\">Throw 2</h2>"));
  EXPECT_THAT(dom,
              HasSubstr("dodgesim replay " + path("out") +
                        " --models " DODGESIM_SOURCE_DIR "/models --throw 2 --video throw2.mp4"));
  EXPECT_THAT(dom, HasSubstr(">launch 0.300 s</button>"));
}

TEST_F(ReportCommandTest, ReportAndTableReadADirectory) {
  fly();
  fs::remove(root_ / "out/report.html");
  const Outcome outcome = dodgesim("report " + path("out"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("Report: " + path("out/report.html")));
  EXPECT_TRUE(fs::exists(root_ / "out/report.html"));

  const Outcome table = dodgesim("table " + path("out") + " --by speed_mps,size_m --format csv");
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_THAT(table.output, ::testing::StartsWith("speed_mps,size_m,pilot,throws,would_have_hit,"));
  EXPECT_EQ(dodgesim("table " + path("out") + " --by 'speed_mps, size_m' --format csv").output,
            table.output);
  EXPECT_EQ(dodgesim("table " + path("out") + " --by colour").exit_code, 2);
  EXPECT_EQ(dodgesim("table " + path("nowhere")).exit_code, 4);
}

TEST_F(ReportCommandTest, ADamagedRecordIsMissedAloud) {
  fly();
  fs::copy(root_ / "out", root_ / "damaged");
  std::string bytes = contents(root_ / "damaged/results.bin");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  std::ofstream(root_ / "damaged/results.bin", std::ios::binary) << bytes;
  const Outcome table = dodgesim("table " + path("damaged"));
  EXPECT_EQ(table.exit_code, 3);
  EXPECT_THAT(table.output,
              HasSubstr("damaged has 3 of 4 throws only; results.bin of " + path("damaged") +
                        " is damaged or cut off, and --resume flies there what was lost.\n"));
}

TEST_F(ReportCommandTest, NothingIsWrittenOverACampaign) {
  fly();
  const std::string results = contents(root_ / "out/results.bin");
  for (const std::string file : {"results.bin", "throws.csv", "table.csv", "manifest.json"}) {
    const std::string out = path("out/" + file);
    const Outcome table = dodgesim("table " + path("out") + " --out " + out);
    EXPECT_EQ(table.exit_code, 2);
    EXPECT_EQ(table.output, "--out " + out + " would overwrite a file of a campaign.\n");
    EXPECT_EQ(dodgesim("report " + path("out") + " --out " + out).exit_code, 2);
  }
  fs::copy(root_ / "out", root_ / "other");
  const std::string other = path("other/report.html");
  EXPECT_EQ(dodgesim("report " + path("out") + " --out " + other).output,
            "--out " + other + " would overwrite a file of another campaign.\n");
  EXPECT_EQ(dodgesim("report " + path("out") + " --out " + path("out/report.html")).exit_code, 0);
  fs::create_symlink(root_ / "out/results.bin", root_ / "link");
  EXPECT_EQ(dodgesim("table " + path("out") + " --out " + path("link")).exit_code, 2);
  EXPECT_EQ(contents(root_ / "out/results.bin"), results);
  EXPECT_EQ(dodgesim("table " + path("out") + " --out " + path("out/mine.md")).exit_code, 0);
  const Outcome slip = dodgesim("table " + path("out") + " --out " + path("s.yaml"));
  EXPECT_EQ(slip.exit_code, 2);
  EXPECT_THAT(slip.output, HasSubstr("s.yaml must end in .md, as --format is md."));
  for (const std::string command : {"check-sensor --camera ideal", "paper table3"}) {
    EXPECT_THAT(dodgesim(command + " --out " + path("out")).output, HasSubstr("holds a campaign"));
  }
}

TEST_F(ReportCommandTest, CompareSaysWhatACampaignLacks) {
  fly();
  const std::string run = "run " + path("s.yaml") + " -j 1 --shard ";
  ASSERT_EQ(dodgesim(run + "0/2 --out " + path("part")).exit_code, 0);
  const Outcome outcome = dodgesim("compare " + path("part") + " " + path("out"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output,
              HasSubstr(path("part") + " has 2 of the 4 throws of its scenario.\n"));
  EXPECT_THAT(outcome.output, Not(HasSubstr(path("out") + " has 4")));
  ASSERT_EQ(dodgesim(run + "6/8 --out " + path("none")).exit_code, 0);
  const Outcome none = dodgesim("compare " + path("out") + " " + path("none"));
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(none.output, path("none") + " has no throw, so there is nothing to compare.\n");
  const Outcome empty = dodgesim(run + "'' --out " + path("empty"));
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.output, HasSubstr("--shard: nothing was given"));
  EXPECT_FALSE(fs::exists(root_ / "empty"));
}

TEST_F(ReportCommandTest, APilotWithoutCamerasHasNoEventsToReplay) {
  fly();
  const Outcome outcome =
      dodgesim("replay " + path("out") + " --throw 1 --events " + path("events.h5"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.output, "--events " + path("events.h5") +
                                ": the pilot of throw 1 is oracle, which flies without cameras.\n");
  EXPECT_FALSE(fs::exists(root_ / "events.h5"));
}

TEST_F(ReportCommandTest, AReplayWithOtherModelsIsRefused) {
  fly();
  const fs::path models = copy_models(root_);
  const std::string replay = "replay " + path("out") + " --throw 1 --models " + models.string();
  EXPECT_EQ(dodgesim(replay).exit_code, 0) << "they are the same";
  std::string ball = contents(models / "objects/ball.xml");
  ball.insert(ball.find("mass=\"") + 6, "1");
  std::ofstream(models / "objects/ball.xml") << ball;
  const Outcome outcome = dodgesim(replay);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr(path("out") + " holds results of other models"));
}

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST_F(ReportCommandTest, ASweepHasACurveWithItsBandForEachCellOfTheGrid) {
  const Outcome run = dodgesim("sweep " + path("s.yaml") + " -j 1 --throws 2 --out " +
                               path("swept") + " --set 'grid={throw.speed_mps: [4, 8]}'" +
                               " --over delays.compute_us=0,10000,30000");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const std::string dom = browse(path("swept/report.html")).output;
  EXPECT_THAT(dom, Not(HasSubstr(":CONSOLE:"))) << dom.substr(0, 4000);
  EXPECT_EQ(count_of(dom, "class=\"band\""), 1 + 2) << "over the speed; over the sweep, by speed";
  EXPECT_THAT(dom, HasSubstr("speed 8 m/s</span>"));
  EXPECT_EQ(count_of(dom, "aria-label=\"delays.compute_us 30000, speed "), 2) << "the table's rows";
  EXPECT_EQ(count_of(dom, "aria-label=\"delays.compute_us 30000, all\""), 1) << "their total";
  // Without --by the cells of the grid are told apart.
  EXPECT_THAT(dodgesim("table " + path("swept") + " --format csv").output,
              ::testing::StartsWith("delays.compute_us,throw.speed_mps,pilot,"));
  const Outcome twice = dodgesim("table " + path("swept") + " --by speed_mps,size_m,speed_mps");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.output, HasSubstr("--by names speed_mps twice."));
}

TEST_F(ReportCommandTest, FitsANarrowScreenAndCanBeReadThere) {
  const Outcome run = dodgesim(
      "run " + path("s.yaml") + " -j 1 --throws 1 --out " + path("wide") +
      " --set pilot=none --set 'name=some_name_that_is_as_long_as_those_of_files_may_well_be'"
      " --set 'grid={throw.size_m: [0.2], throw.speed_mps: [4, 4.5, 5, 5.5, 6, 6.5, 7, 7.5]}'");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  write("measured.html",
        contents("wide/report.html") +
            "<script>const heat = document.querySelector('.heat');"
            "document.body.dataset.fits ="
            " document.documentElement.scrollWidth <= innerWidth;"
            "document.body.dataset.readable ="
            " heat.getBoundingClientRect().width > 0.7 * heat.viewBox.baseVal.width"
            "</script>");
  const std::string dom = browse(path("measured.html"), 400).output;
  EXPECT_THAT(dom, HasSubstr("data-fits=\"true\""));
  EXPECT_THAT(dom, HasSubstr("data-readable=\"true\""));
}

// Text of the page between two others, without its marks.
std::string text_between(const std::string& dom, const std::string& start, const std::string& end) {
  const std::size_t from = dom.find(start);
  if (from == std::string::npos) return "no " + start;
  std::string text;
  bool mark = false;
  for (const char c : dom.substr(from, dom.find(end, from) - from)) {
    if (c == '<') text += mark ? "" : "|";
    mark = (mark || c == '<') && c != '>';
    if (!mark && c != '>') text += c;
  }
  return text;
}

TEST_F(ReportCommandTest, RatesAreNamedByWhatThePilotIsForNotByItsName) {
  const Outcome none =
      dodgesim("run " + path("s.yaml") + " -j 1 --set pilot=none --out " + path("none"));
  ASSERT_EQ(none.exit_code, 0) << none.output;
  const std::string of_none = browse(path("none/report.html")).output;
  EXPECT_THAT(of_none, Not(HasSubstr(":CONSOLE:"))) << of_none.substr(0, 4000);
  EXPECT_THAT(text_between(of_none, "id=\"figures\"", "</header>"),
              ::testing::ContainsRegex("dodged by none.*would have hit.*detected"));
  EXPECT_THAT(text_between(of_none, "id=\"causes\"", "</section>"),
              AllOf(HasSubstr("so no cause is told."), Not(HasSubstr("No throw hit"))));

  dodgesim("sweep " + path("s.yaml") + " -j 1 --throws 3 --out " + path("pilots") +
           " --set fly_oracle=true --over pilot=none,oracle");
  const std::string swept = browse(path("pilots/report.html")).output;
  EXPECT_THAT(swept, Not(HasSubstr(":CONSOLE:"))) << swept.substr(0, 4000);
  const std::string table = text_between(swept, "id=\"sweep-table\"", "</section>");
  EXPECT_THAT(table, ::testing::ContainsRegex("dodged by the pilot of the sweep.*"
                                              "dodged by oracle.*would have hit"));
  // The oracle's row: what it dodged, nobody beside it, and how many would have hit.
  EXPECT_THAT(table, ::testing::ContainsRegex("[|]oracle[|]+[01][.][0-9]+ [^|]*[|]+[01][.]"));
}

TEST_F(ReportCommandTest, ALegendNamesTheCurvesThatAreDrawn) {
  dodgesim("sweep " + path("s.yaml") + " -j 1 --throws 1 --out " + path("pilots") +
           " --set fly_oracle=true --over pilot=none,oracle --over throw.speed_mps=5,6");
  const std::string dom = browse(path("pilots/report.html")).output;
  EXPECT_THAT(dom, Not(HasSubstr(":CONSOLE:"))) << dom.substr(0, 4000);
  const std::string curves = text_between(dom, "id=\"sweep-curve\"", "id=\"sweep-table\"");
  // Where the oracle flies as the pilot, no other one flies beside it.
  EXPECT_THAT(curves, ::testing::ContainsRegex(
                          "the pilot of the sweep[|].*[|]pilot none[|]+pilot oracle[|]+oracle[|]"));
  EXPECT_THAT(curves.substr(curves.find("|oracle|")),
              AllOf(HasSubstr("|pilot none|"), Not(HasSubstr("|pilot oracle|"))));
}

TEST_F(ReportCommandTest, ErrorsAreNamed) {
  dodgesim("run " + path("s.yaml") + " -j 1 --set 'mission.start_m=[3, 0, 2]' --out " +
           path("wall"));
  const std::string dom = browse(path("wall/report.html")).output;
  EXPECT_THAT(dom, Not(HasSubstr(":CONSOLE:"))) << dom.substr(0, 4000);
  const std::string errors = text_between(dom, "id=\"errors\"", "</section>");
  EXPECT_THAT(errors, HasSubstr("Throws that no pilot could fly, which no rate counts: 4."));
  EXPECT_THAT(errors, HasSubstr("Throw 2| The throw starts at ("));
}

TEST_F(ReportCommandTest, ASweepOverNamesSaysThatThereIsNoCurve) {
  dodgesim("sweep " + path("s.yaml") + " -j 1 --throws 2 --out " + path("names") +
           " --over throw.object=ball,box");
  const std::string dom = browse(path("names/report.html")).output;
  EXPECT_THAT(dom, Not(HasSubstr(":CONSOLE:"))) << dom.substr(0, 4000);
  EXPECT_THAT(dom, HasSubstr("No key of the sweep is a number: no curve."));
  EXPECT_THAT(dom, HasSubstr("aria-label=\"throw.object box\""));
}

// 20 of 200 throws are enough for so wide an interval.
TEST_F(ReportCommandTest, ACampaignThatStopEndedIsWhole) {
  const Outcome run = dodgesim("run " + path("s.yaml") + " -j 1 --out " + path("early") +
                               " --throws 200 --set 'stop={half_width: 0.3}'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const Outcome table = dodgesim("table " + path("early"));
  EXPECT_EQ(table.exit_code, 0) << table.output;
  EXPECT_THAT(table.output, HasSubstr("sequential 95 %"));
  EXPECT_THAT(table.output, ::testing::ContainsRegex("ended by stop after [0-9]+ of at most 200"));
  const Outcome report = dodgesim("report " + path("early"));
  EXPECT_EQ(report.exit_code, 0) << report.output;
  const Outcome check = dodgesim("merge --check " + path("early"));
  EXPECT_EQ(check.exit_code, 0) << check.output;
  const Outcome page = browse(path("early/report.html"));
  EXPECT_THAT(page.output, Not(HasSubstr(":CONSOLE:"))) << page.output.substr(0, 4000);
  EXPECT_THAT(page.output, HasSubstr("<p id=\"stop\">Ended by stop after "));
  EXPECT_THAT(page.output, HasSubstr(", sequential 95 %</span>"));
  EXPECT_THAT(page.output, Not(HasSubstr(" of 200</dd>"))) << "it lacks none";
}

}  // namespace
