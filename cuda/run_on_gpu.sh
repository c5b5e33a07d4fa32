#!/usr/bin/env bash
# run_on_gpu.sh [BUILD [RESULTS]]: everything that needs a GPU, in one call of under ten minutes: builds (unless BUILD
# holds a build already), runs every GPU test with compute-sanitizer among them, then measures the paper's Tables 3
# and 4 and beyond, each answer compared with the exact reference in the same run. Leaves RESULTS/gpu_tests.txt and
# RESULTS/gpu_tables.json (Google Benchmark's format, with GPU, driver, toolkit and commit).
set -euo pipefail
source=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$source/build/gpu} results=${2:-$build/results}
mkdir -p "$results"

if [ ! -x "$build/catena_tests" ]; then
  cmake -S "$source" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCATENA_CUDA=ON -DCATENA_CUDA_ARCHITECTURES=native
  cmake --build "$build"
fi

nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv | tee "$results/gpu_tests.txt"
sed -n 's/^#define CATENA_COMMIT "\(.*\)"$/commit \1/p' "$build"/generated/commit.h | tee -a "$results/gpu_tests.txt"
ctest --test-dir "$build" -L gpu -j 8 --output-on-failure 2>&1 | sed '/^Test project /d' | tee -a "$results/gpu_tests.txt"

# The paper's, resident and from host to host; then what a user would take, of laid out chains and of tangled ones.
device='path[12]/n:[0-9]+/(GPU1|aGPU2[+]GPUv?2)/(build|find|whole)/|path[12]/n:[0-9]+/(aGPU2[+]GPU2|Device[A-Za-z]+)/resident/|path[12]/n:1000/bGPU2[+]GPUv?2/(build|find|whole)/'
host='path[12]/n:[0-9]{4,6}/aCPU2[+]CPU2/(build|find)/'
ours='path[12]/n:[0-9]+/(auto|Hybrid|Device(Hybrid|Tree|Capsules|Grid|LBVH))/whole/|yarn/n:([0-9]{4,6}|[13]000000)/((auto|Hybrid|Device(Hybrid|Grid|LBVH))/whole|Device(Hybrid|Grid|LBVH)/resident)/'
peers='(path[12]|yarn)/n:[0-9]{4,6}/Embree(Rebuild)?/whole/'
arithmetics='path[12]/n:150000/(GPU1|aGPU2[+]GPUv?2|aCPU2[+]CPU2)/literal/(build|find)/'
"$build/catena_bench" --benchmark_filter="$device|$host|$ours|$peers|$arithmetics" --benchmark_min_time=0.02 \
  --benchmark_repetitions=3 --benchmark_enable_random_interleaving=true --benchmark_display_aggregates_only=true \
  --benchmark_out="$results/gpu_tables.json" --benchmark_out_format=json | tee "$results/gpu_tables.txt"
