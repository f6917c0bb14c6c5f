#!/bin/bash
# Fig. 4.8 of the dissertation: quaking aspen (left), silver birch (right), and their blend (centre).
#   experiments/figure_4_8.sh [OUT.png]
set -euo pipefail
root=$(dirname "$(readlink -f "$0")")/..
"$root/espalier" blend quaking_aspen silver_birch --strip 3 "${1:-$root/experiments/figure_4_8.png}" --tile 320
