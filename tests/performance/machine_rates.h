#pragma once

/** What this machine can do at most, measured: the two ceilings of the roofline (Williams, Waterman, Patterson, 2009, CACM 52(4), 65). */
namespace performance
{
  /** Read and write of main memory by a[i] = b[i] + s c[i] (McCalpin's STREAM triad), writes counted once [B/s]. */
  double triad_bandwidth(int threads);

  /** Reading of main memory by a sum [B/s]. */
  double read_bandwidth(int threads);

  /** Fused multiply-adds on packs held in registers, two operations each [1/s]. */
  double arithmetic_rate(int threads);
} // namespace performance
