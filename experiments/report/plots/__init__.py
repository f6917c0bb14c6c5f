"""The plots of a report, one module each.

A module has draw(directory, meta) -> {stem: figure}: it reads its CSV files and gives nothing where they are not
there. The order here is that of the page."""

from plots import convergence, data_profile, generations, growth_complexity, growth_times, ranks, sheet

ALL = [sheet, generations, convergence, data_profile, ranks, growth_times, growth_complexity]
