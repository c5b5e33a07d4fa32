#!/usr/bin/env bash
# sanitize.sh TOOL CATENA: runs the GPU strategies under one tool of compute-sanitizer (memcheck, racecheck,
# initcheck, synccheck). Exit code 77 means skipped, with the reason; ctest shows it so.
set -euo pipefail
tool=$1 catena=$2
command -v compute-sanitizer >/dev/null || { echo "skipped: compute-sanitizer is not on the PATH"; exit 77; }
reason=$("$catena" list | sed -n 's/^  aGPU2+GPU2 *not available: //p')
[ -z "$reason" ] || { echo "skipped: $reason"; exit 77; }

options=(--tool "$tool" --error-exitcode 9)
[ "$tool" != memcheck ] || options+=(--leak-check full)
variants=()
for v in GPU1 bGPU2+GPU2 bGPU2+GPUv2 aGPU2+GPU2 aGPU2+GPUv2 "aGPU2(subtree=6,block=2)+GPU2" aCPU2+GPU2 aGPU2+CPU2 \
         DeviceGrid "DeviceGrid(binned=0)" DeviceHybrid "DeviceHybrid(least=0)" "DeviceHybrid(least=0,cells=0,crowd=2)" "DeviceHybrid(least=0,cells=0,survey=0)" DeviceLBVH DeviceCapsules DeviceTree "DeviceParts(parts=3,group=4)" "DeviceParts(parts=3,group=8,order=space)" GPU1/literal aGPU2+GPU2/literal aGPU2+GPUv2/literal bGPU2+GPU2/literal; do
  variants+=(--variant "$v")
done
compute-sanitizer "${options[@]}" "$catena" verify "${variants[@]}" \
  path1:n=1537 hair:n=1000 torus_knot:n=800 walk:n=900 coil:n=700,offset=1e6 coil:n=500,scale=1e-25 rod:n=0 rod:n=1 rod:n=385 \
  yarn:n=2000 mixed_radii:n=900,decades=6 coincident:n=300
# And their evidence: what the device built is copied to the host.
compute-sanitizer "${options[@]}" "$catena" verify --certify --variant DeviceGrid --variant "DeviceHybrid(least=0)" \
  --variant "DeviceHybrid(least=0,cells=0,crowd=2)" --variant DeviceLBVH --variant DeviceCapsules --variant DeviceTree path1:n=1537 yarn:n=2000 mixed_radii:n=900,decades=6
# Blocks of a search that go round several times.
compute-sanitizer "${options[@]}" "$catena" detect lattice:n=700000 --variant "DeviceHybrid(crowd=0)"
