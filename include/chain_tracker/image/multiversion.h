// SPDX-License-Identifier: BSD-3-Clause
/// Marks a hot loop to be compiled for several instruction sets, chosen when the program starts, so
/// that one portable binary is fast everywhere. No set with fused multiply-add: results are then
/// the same on every machine.
#pragma once

#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CHAIN_TRACKER_MULTIVERSION __attribute__((target_clones("avx2", "default")))
#else
#define CHAIN_TRACKER_MULTIVERSION
#endif
