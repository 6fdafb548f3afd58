// SPDX-License-Identifier: Apache-2.0
// These functions share out the memory of a rank under --memory.
#pragma once

#include <cstdint>

namespace vitrail {

// It keeps --memory, a promise about the pages that are resident in a rank (VmHWM), those of mapped files
// included. The system's cache of files beyond that is its own: it gives it back when others need memory.
struct MemoryPlan {
  std::uint64_t domains_bytes = 0;  // for mapped domains
  std::uint64_t queue_bytes = 0;    // for rays that wait or travel
};

struct Manifest;

// It is the domain of a scene that needs most.
struct LargestDomain {
  std::uint64_t bytes = 0;    // of its file and of all objects that it places
  std::uint64_t objects = 0;  // of these, the objects'
};
LargestDomain largest_domain(const Manifest& manifest);

// Returns the least budget that would do; its arguments are those of plan_memory.
std::uint64_t least_memory(std::uint64_t base, std::uint64_t peak, int threads, std::uint64_t largest_domain);

// They are bytes for tiles of images: within this budget, and for all tiles. With more memory tiles take
// more, up to this part.
struct TileMemory {
  std::uint64_t within = 0, all = 0;
};
inline constexpr std::uint64_t tile_share = 4;

// Shares out `budget` for the whole rank, 0: no limit. `base` is resident already, film, manifest and tiles
// within the budget included; `peak` is resident at the highest so far, or later while the picture is made.
// `largest_domain` has to fit. Throws MachineError with the least budget that would do, in which tiles take
// more, and with smaller domains where these help.
MemoryPlan plan_memory(std::uint64_t budget, std::uint64_t base, std::uint64_t peak, int threads,
                       LargestDomain largest, std::uint64_t all_domains, TileMemory tiles = {});

// It is the memory of a rank's film, whose sums take `bytes`: all of it is in memory, or files hold it and a
// window of them is.
struct FilmMemory {
  std::uint64_t bytes = 0;
  std::uint64_t window = 0;  // bytes; 0: all of it is in memory
  std::uint64_t resident() const;
};

// Returns a film in memory where there is no budget, where it is no larger than two of the least windows, or
// where all domains have room beside it. It is in memory, too, where it takes half the budget at most and the
// largest domain has room. Else it is in files. `base` and `peak` are without the film.
FilmMemory place_film(std::uint64_t film_bytes, std::uint64_t budget, std::uint64_t base, std::uint64_t peak,
                      int threads, std::uint64_t largest_domain, std::uint64_t all_domains);
// Gives the window the bytes that no domain needs, or half of what the largest domain leaves if that is more.
void widen_window(FilmMemory& film, MemoryPlan& plan, std::uint64_t largest_domain,
                  std::uint64_t all_domains);

// It is the room for rays where tests say how much there is for domains: the rays go to the disk.
inline constexpr std::uint64_t few_rays_bytes = 1 << 18;

// Returns the most rays a rank that may be alive in the whole job. The disk takes those that the queues have
// no room for.
std::int64_t rays_allowed_a_rank(const MemoryPlan& plan);
// Returns the same where rays are in flow (scheduler/residency.h): with more of them the ranks before the
// camera have all at once while the others have nothing yet.
std::int64_t rays_allowed_in_flow(int threads);

// They are parts of queue_bytes. The farm holds these bounds, whatever comes.
struct QueueBounds {
  std::uint64_t waiting = 0, outgoing = 0, being_sent = 0;  // bytes
  std::uint64_t questions = 0;  // of what waits: what paths ask the photons of a rank
};
QueueBounds queue_bounds(const MemoryPlan& plan, int ranks);
// Returns the same where photons fly: half of what waits may be questions. A rank alone asks none.
QueueBounds queue_bounds_with_photons(const MemoryPlan& plan, int ranks);

// Returns the bytes of the farm's tables, which grow with the number of domains: queues, counts, and the
// table of resident domains, of which every thread may hold one of its own.
std::uint64_t table_bytes(std::uint64_t domains, int threads);

// Returns the bytes of --profile's counts, on every thread, and of their sums on rank 0.
std::uint64_t profile_bytes(std::uint64_t domains, int threads);

// Returns the bytes that MPI keeps for the other ranks, once there are messages.
std::uint64_t connection_bytes(int ranks);

}  // namespace vitrail
