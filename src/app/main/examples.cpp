#include <CLI/CLI.hpp>
#include <string>

#include <espalier/app/main/examples.h>
#include <espalier/core/error.h>

namespace espalier {

namespace {

struct Examples {
  const char* command;
  const char* lines[3];
};

constexpr Examples kExamples[] = {
    {"fit",
     {"espalier fit oak.png --seconds 60", "espalier fit oak.png --species quaking_aspen -o runs/oak",
      "espalier fit --resume runs/oak --seconds 300"}},
    {"posterior",
     {"espalier posterior oak.png", "espalier posterior oak.png --height 14 -o runs/oak-posterior",
      "espalier posterior pine.png --table ten_metres.bin"}},
    {"trials",
     {"espalier trials runs/oak", "espalier trials runs/oak -o points.csv",
      "espalier trials old_run --picture oak.png"}},
    {"target",
     {"espalier target oak.png -o mask.png",
      "espalier target oak.png -o mask.png --size 512 --sheet sheet.png",
      "espalier target scan.jpg -o mask.png --separation luminance --tree-side dark"}},
    {"compare",
     {"espalier compare runs/oak/best.png runs/oak/target.png", "espalier compare a.png b.png --json",
      "espalier compare a.png b.png --frame --overlay differences.png"}},
    {"species",
     {"espalier species", "espalier species quaking_aspen > mine.toml",
      "espalier species --check mine.toml"}},
    {"lsystem",
     {"espalier lsystem", "espalier lsystem fern -o fern.png",
      "espalier lsystem my.lsys --steps 4 --set angle=30 --string"}},
    {"render",
     {"espalier render quaking_aspen -o aspen.png",
      "espalier render palm -o palm.png --size 1024x768 --view 30,10 --ground",
      "espalier render runs/oak/best.toml -o oak.png --season autumn"}},
    {"mesh",
     {"espalier mesh quaking_aspen -o aspen.glb", "espalier mesh palm -o palm.obj --detail high",
      "espalier mesh runs/oak/best.toml -o oak.stl --seed 3"}},
    {"mask",
     {"espalier mask quaking_aspen -o aspen.png", "espalier mask palm -o palm.png --size 256 --view 90,0",
      "espalier mask fern.lsys -o fern.png --steps 4"}},
    {"params",
     {"espalier params", "espalier params --format markdown", "espalier params --model small_pine.lsys"}},
    {"space",
     {"espalier space map.svg", "espalier space sheet.png --grid 7x7",
      "espalier space --components 3 --save mine.toml"}},
    {"blend",
     {"espalier blend palm small_pine -o between.toml",
      "espalier blend palm small_pine --t 0.3 -o between.toml",
      "espalier blend palm small_pine --strip 7 strip.png"}},
    {"experiment",
     {"espalier experiment run experiments/quick.toml", "espalier experiment report runs/quick",
      "espalier experiment check runs/quick"}},
    {"experiment run",
     {"espalier experiment run experiments/quick.toml",
      "espalier experiment run mine.toml --jobs 4 -o runs/mine",
      "espalier experiment run mine.toml --set 'seconds=2' 'seeds=[1, 2]'"}},
    {"experiment report",
     {"espalier experiment report runs/quick", "espalier experiment report runs/mine",
      "espalier experiment report ."}},
    {"experiment check",
     {"espalier experiment check runs/quick", "espalier experiment check runs/mine mine.expected.toml",
      "espalier experiment check ."}},
    {"experiment compare",
     {"espalier experiment compare runs/before runs/after",
      "espalier experiment compare runs/before runs/after -o runs/comparison",
      "espalier experiment compare runs/before ."}},
    {"experiment export",
     {"espalier experiment export runs/quick --format iohprofiler -o ioh",
      "espalier experiment export runs/quick --format coco -o coco",
      "espalier experiment export . --format coco -o ../coco"}},
    {"bench",
     {"espalier bench --species quaking_aspen", "espalier bench --json here.json --plot scaling.svg",
      "espalier bench --compare there.json"}},
    {"reference", {"espalier reference fit", "espalier reference measures", "espalier reference optimizers"}},
    {"completion",
     {"source <(espalier completion bash)", "source <(espalier completion zsh)",
      "espalier completion fish | source"}},
};

std::string in_lines(const Examples& examples) {
  std::string text = "Examples:\n";
  for (const char* line : examples.lines) text += std::string("  ") + line + "\n";
  return text;
}

void add_to(CLI::App& command, const std::string& name) {
  for (const Examples& examples : kExamples)
    if (name == examples.command) {
      const std::string own = command.get_footer();
      command.footer(in_lines(examples) + (own.empty() ? "" : "\n" + own));
    }
  for (CLI::App* sub : command.get_subcommands({})) add_to(*sub, name + " " + sub->get_name());
}

}  // namespace

void add_examples(CLI::App& app) {
  app.footer(
      "Examples:\n  espalier fit oak.png              # a minute, into runs/oak-1\n"
      "  espalier render quaking_aspen -o aspen.png\n  espalier species\n\n"
      "espalier COMMAND --help says what a command takes.");
  for (CLI::App* command : app.get_subcommands({})) add_to(*command, command->get_name());
}

}  // namespace espalier
