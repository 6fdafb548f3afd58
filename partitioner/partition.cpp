// SPDX-License-Identifier: Apache-2.0
#include "partitioner/partition.h"

#include <fmt/format.h>
#include <malloc.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stdexcept>

#include "bundle/matte_names.h"
#include "bundle/packs.h"
#include "images/image_files.h"
#include "partitioner/arena_threads.h"
#include "partitioner/caching/bundle_cache.h"
#include "partitioner/caching/world_key.h"
#include "partitioner/cutting/kd_plan.h"
#include "partitioner/divide_cell.h"
#include "partitioner/least_memory.h"
#include "partitioner/memory_ledger.h"
#include "partitioner/memory_plan.h"
#include "partitioner/object_budget.h"
#include "partitioner/placing/flatten.h"
#include "partitioner/placing/place_scene.h"
#include "partitioner/spilling/spill_instances.h"
#include "partitioner/spilling/spill_scene.h"
#include "partitioner/writing/bundle_directory.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/system/resource_usage.h"

namespace vitrail {

namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t directory_bytes(const std::filesystem::path& directory) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

PartitionStats statistics(const Manifest& m, const CensusResult& census,
                          const std::filesystem::path& bundle) {
  PartitionStats s;
  s.input_triangles = m.triangles;
  s.cut_triangles = census.cut_triangles;
  s.pieces = census.pieces;
  s.domains = m.domains.size();
  s.triangles_min = m.domains[0].triangles;
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < m.domains.size(); ++i)
    s.domain_bytes_max = std::max(s.domain_bytes_max, bytes_needed(m, i));
  for (const DomainInfo& d : m.domains) {
    s.instances += d.instances;
    s.triangles_min = std::min(s.triangles_min, d.triangles);
    s.triangles_max = std::max(s.triangles_max, d.triangles);
    sum += d.triangles;
  }
  s.triangles_mean = static_cast<double>(sum) / static_cast<double>(m.domains.size());
  s.objects = m.objects.size();
  s.bundle_bytes = directory_bytes(bundle);
  s.duplicates = census.duplicates;
  s.area_error = census.area_error;
  return s;
}

// By the materials of the bundle; those that nothing is made of are left out.
std::vector<KeptGlazing> in_bundle(std::vector<KeptGlazing> glazings,
                                   const std::vector<std::int32_t>& material_ids) {
  const auto number = [&](std::uint32_t id) { return material_ids.at(id); };
  for (KeptGlazing& glazing : glazings) {
    std::erase_if(glazing.sheets, [&](const auto& s) { return number(s.front) < 0 || number(s.back) < 0; });
    for (auto& [front, back] : glazing.sheets)
      front = static_cast<std::uint32_t>(number(front)), back = static_cast<std::uint32_t>(number(back));
  }
  std::erase_if(glazings, [](const KeptGlazing& glazing) { return glazing.sheets.empty(); });
  return glazings;
}

// Enough for a disk; larger ones only leave the processor's caches.
constexpr std::uint64_t most_spill_buffer_bytes = 4 << 20;

using ProgressFunction = std::function<void(double, const char*)>;

// Phases in order, each with its share of the whole; work is counted from any thread.
class Phases {
 public:
  explicit Phases(const ProgressFunction& report) : report_(report) {}

  void begin(const char* name, double share, std::uint64_t work) {
    const std::lock_guard lock(mutex_);
    before_ += share_;
    name_ = name, share_ = share, work_ = std::max<std::uint64_t>(work, 1), done_ = 0;
    if (report_) report_(before_, name_);
  }
  void advance(std::uint64_t work) {
    const std::lock_guard lock(mutex_);
    done_ = std::min(done_ + work, work_);
    if (report_) report_(before_ + share_ * static_cast<double>(done_) / static_cast<double>(work_), name_);
  }
  void end() {
    const std::lock_guard lock(mutex_);
    if (report_) report_(1, name_);
  }

 private:
  const ProgressFunction& report_;
  std::mutex mutex_;
  const char* name_ = "";
  double before_ = 0, share_ = 0;
  std::uint64_t work_ = 1, done_ = 0;
};

// Gives each domain the file of its old number.
void rename_domains(const std::filesystem::path& bundle, std::span<const std::uint32_t> old_numbers) {
  const auto on_the_way = [&](std::uint32_t number) {
    std::filesystem::path file = domain_path(bundle, number);
    return file += ".numbered";
  };
  for (std::uint32_t i = 0; i < old_numbers.size(); ++i)
    if (old_numbers[i] != i) std::filesystem::rename(domain_path(bundle, old_numbers[i]), on_the_way(i));
  for (std::uint32_t i = 0; i < old_numbers.size(); ++i)
    if (old_numbers[i] != i) std::filesystem::rename(on_the_way(i), domain_path(bundle, i));
}

// What one call of `partition` works with.
class Partitioner {
 public:
  Partitioner(const Scene& scene, std::filesystem::path bundle, const PartitionOptions& options,
              const ProgressFunction& progress)
      : scene_(scene),
        options_(options),
        bundle_(std::move(bundle)),
        median_(options.median),
        phases_(progress),
        world_(world_of(scene, bundle_, {!options.flatten, options.everything, options.cache})) {
    coarse_ = world_.coarse;
    glazings_ = in_bundle(options.glazings, world_.material_ids);
    quadrics_ = world_.quadrics;
    shape_names_ = std::move(world_.shape_names);
  }

  // A profile is no scene's content.
  PartitionStats run() {
    const BundleCache cache(options_.profile ? std::filesystem::path() : options_.bundles);
    if (!cache.is_on()) return finish(place());
    const WorldKey key(world_, scene_.settings, options_);
    if (std::optional<PlacedScene> placed = cache.take(key.text(), bundle_)) {
      place_as(*placed);
      return finish(placed->census);
    }
    const CensusResult found = place();
    PlacedScene placed{std::move(manifest_), std::move(block_hashes_), found};
    if (key.holds()) cache.keep(key.text(), bundle_, placed);
    manifest_ = std::move(placed.manifest);
    return finish(found);
  }

 private:
  // Objects, and how the rest is to be divided.
  void begin() {
    const PartitionOptions& options = options_;
    const std::uint64_t file_bytes = most_object_bytes(options.domain_bytes);
    MemoryNeeds needs = needs_of(scene_, options);
    needs.triangles = world_.own_triangles;
    needs.scene_bytes += emissive_triangles_of(world_) * sizeof(EmissiveTriangle);
    needs.instance_bytes = world_.uses.size() * bytes_of_reference;
    for (const WorldObject& o : world_.objects)
      needs.object_bytes =
          std::max(needs.object_bytes, bytes_in_work(world_.manifest, o.assembly, file_bytes));
    for (const QuadricRun& run : world_.runs)
      needs.quadrics += run.places->size() * (is_curve(*run.quadric) ? 3 : 1);
    items_ = world_.own_triangles + world_.uses.size();
    plan_ = plan_with_pieces(needs);  // before anything is written, where it is too little
    const std::uint64_t in_objects = triangles_of_objects(world_);
    const auto all = static_cast<double>(std::max<std::uint64_t>(in_objects + world_.own_triangles, 1));
    phases_.begin("writing objects", static_cast<double>(in_objects) / all, in_objects);
    instances_ = write_objects(world_, world_.manifest, bundle_,
                               {file_bytes, options.domain_bytes / 2, bytes_left(needs)},
                               [&](std::uint64_t n) { phases_.advance(n); });
    rest_ = static_cast<double>(world_.own_triangles) / all;
    needs.instance_bytes = instances_.refs.size() * bytes_of_reference;
    items_ = world_.own_triangles + instances_.refs.size() + instances_.in_runs();
    plan_ = plan_with_pieces(needs);
    if (options.domains == 0 && options.domain_bytes > 0 && !instances_.refs.empty()) {
      needs.domains = domains_within(world_, instances_, options.domain_bytes, plan_.domains);
      plan_ = plan_with_pieces(needs);
    }
    if (options.domains_at_once > 0)
      plan_.domains_at_once = std::min(plan_.domains_at_once, options.domains_at_once);
    if (options.profile) work_ = {*options.profile, world_.manifest.offset};
    world_.manifest.domains.resize(plan_.domains);
    world_.manifest.kd_nodes.resize(plan_.domains - 1);
  }

  CensusResult place() {
    begin();
    Census census(world_.manifest.triangles, ids_of_instances());
    if (plan_.domains_at_once >= plan_.domains)
      at_once(census);
    else
      by_buckets(census);
    const CensusResult found = census.result();
    if (found.lost != 0)
      throw std::logic_error(fmt::format("partitioning lost {} triangles; please report this", found.lost));
    manifest_.cut_triangles = found.cut_triangles;
    rename_domains(bundle_, number_domains(manifest_, shared_.take()));
    return found;
  }

  // What the placed scene is made of is what this one is.
  void place_as(PlacedScene& placed) {
    manifest_ = std::move(world_.manifest);
    Manifest& from = placed.manifest;
    manifest_.cut_triangles = from.cut_triangles;
    manifest_.bounds = from.bounds;
    manifest_.scale = from.scale;
    manifest_.kd_nodes = std::move(from.kd_nodes);
    manifest_.domains = std::move(from.domains);
    manifest_.objects = std::move(from.objects);
    manifest_.emissive_triangles = std::move(from.emissive_triangles);
    manifest_.emissive_attributes = std::move(from.emissive_attributes);
    manifest_.emissive_opacities = std::move(from.emissive_opacities);
    manifest_.emissive_quadrics = std::move(from.emissive_quadrics);
    manifest_.scene_hash = scene_hash_of(world_, manifest_, placed.block_hashes);
  }

  PartitionStats finish(const CensusResult& found) {
    manifest_.switching_glazings = static_cast<std::uint32_t>(glazings_.size());
    if (options_.pack_bytes > 0) write_packs(bundle_, manifest_, options_.pack_bytes);
    write_manifest(bundle_, manifest_);
    if (tells_shapes(manifest_.film.layers)) write_shape_names(bundle_, shape_names_);
    write_glazings(bundle_, manifest_.scene_hash, glazings_);
    phases_.end();
    PartitionStats stats = statistics(manifest_, found, bundle_);
    stats.buckets = buckets_;
    stats.domains_planned = std::max<std::uint64_t>(plan_.domains, stats.domains);
    stats.spill_bytes = spill_bytes_;
    stats.coarse_shapes = coarse_;
    stats.quadrics = quadrics_;
    stats.input_triangles -= quadrics_;
    return stats;
  }

  // As many pieces are reckoned with as a sample becomes.
  PartitionMemory plan_with_pieces(MemoryNeeds& needs) const {
    constexpr std::uint64_t samples = 1u << 15;
    const std::uint32_t domains = number_of_domains(world_.manifest, needs);
    if (domains > 1 && !median_) {
      const std::vector<Bounds3f> boxes = sample_of(world_, {}, samples);
      std::vector<KdNode> nodes(domains - 1);
      const KdPlan plan = plan_whole_tree(boxes, domains, 1, nodes);
      double items = 0;
      for (const std::size_t n : plan.samples) items += static_cast<double>(n);
      if (!boxes.empty()) needs.expansion = items / static_cast<double>(boxes.size());
    }
    return plan_memory(world_.manifest, needs);
  }

  // From a sample of all.
  KdPlan plan_whole_tree(const std::vector<Bounds3f>& sample, std::uint32_t domains,
                         std::uint32_t domains_in_leaf, std::span<KdNode> nodes) const {
    Bounds3f bounds;
    for (const Bounds3f& b : sample) extend(bounds, b);
    const auto items = static_cast<double>(sample.size());
    return plan_kd_tree(work_.items(sample), {bounds, 0, 0, domains},
                        {items / domains, domains_in_leaf, median_, items / static_cast<double>(items_)},
                        nodes);
  }

  void at_once(Census& census) {
    const std::uint64_t triangles = world_.own_triangles;
    phases_.begin("placing triangles", 0.2 * rest_, triangles);
    FlatScene flat =
        flatten(std::move(world_), plan_.load_bytes, [&](std::uint64_t n) { phases_.advance(n); });
    manifest_ = std::move(flat.manifest);
    block_hashes_ = std::move(flat.block_hashes);
    phases_.begin("cutting and writing domains", 0.8 * rest_, triangles);
    const InstanceDealer instances = dealer_of_all(manifest_.bounds);
    divide_cell(flat, {}, {manifest_.bounds, 0, 0, plan_.domains}, writer(census, instances));
  }

  void by_buckets(Census& census) {
    ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(plan_.kept_bytes));
    ::mallopt(M_TRIM_THRESHOLD, static_cast<int>(4 * plan_.kept_bytes));
    ::malloc_trim(0);
    const std::uint64_t triangles = world_.own_triangles;
    phases_.begin("planning", 0.01 * rest_, 1);
    const std::vector<Bounds3f> sample = sample_of(world_, instances_);
    Bounds3f bounds;
    for (const Bounds3f& b : sample) extend(bounds, b);
    const KdPlan top =
        plan_whole_tree(sample, plan_.domains, plan_.domains_at_once, world_.manifest.kd_nodes);
    buckets_ = top.leaves.size();
    phases_.begin("sorting triangles into parts", 0.4 * rest_, triangles);
    BucketSpill spill(bundle_ / "spill", buckets_, world_.rule(),
                      std::min(plan_.spill_bytes / buckets_, most_spill_buffer_bytes));
    SceneTally tally(world_);
    spill_scene(world_, top, plan_.load_bytes, spill, tally, [&](std::uint64_t n) { phases_.advance(n); });
    tally.finish(world_.manifest);
    block_hashes_ = tally.block_hashes();
    std::vector<Bounds3f> cells;
    for (const Subtree& leaf : top.leaves) cells.push_back(leaf.cell);
    InstanceSpill runs(bundle_ / "spill", cells, bounds,
                       std::min(plan_.spill_bytes / buckets_, most_spill_buffer_bytes));
    instances_.for_each_of_runs([&](const InstanceRef& ref) { runs.add(ref); });
    runs.flush();
    spill_bytes_ = spill.bytes() + runs.bytes();
    ::malloc_trim(0);
    manifest_ = std::move(world_.manifest);
    const InstanceDealer instances(std::move(instances_.refs), bounds);
    phases_.begin("cutting and writing domains", 0.59 * rest_, triangles);
    for (std::size_t i = 0; i < buckets_; ++i) {
      const LoadedCell cell = spill.take(i);
      std::vector<InstanceRef> refs = runs.take(i);  // most of them
      const std::vector<InstanceRef> others = instances.whole_in(top.leaves[i].cell);
      refs.insert(refs.begin(), others.begin(), others.end());
      if (!std::ranges::is_sorted(refs, {}, &InstanceRef::first_triangle))
        std::ranges::stable_sort(refs, {}, &InstanceRef::first_triangle);
      const InstanceDealer here(std::move(refs), bounds);
      divide_cell(cell.triangles, cell.cut, top.leaves[i], writer(census, here));
      std::vector<std::uint32_t> open;
      for (const Piece& p : cell.cut.pieces) open.push_back(cell.triangles.ids[p.triangle]);
      census.settle(open);
    }
  }

  DomainWriter writer(Census& census, const InstanceDealer& instances) {
    return {domain_files(bundle_),
            manifest_,
            census,
            instances,
            shared_,
            options_.domain_bytes,
            work_,
            items_,
            median_,
            plan_.domains_in_work,
            [&](std::uint64_t n) { phases_.advance(n); }};
  }

  // With those of runs.
  InstanceDealer dealer_of_all(const Bounds3f& root) {
    std::vector<InstanceRef> refs = std::move(instances_.refs);
    instances_.for_each_of_runs([&](const InstanceRef& ref) { refs.push_back(ref); });
    std::ranges::stable_sort(refs, {}, &InstanceRef::first_triangle);
    return {std::move(refs), root};
  }

  std::vector<IdRange> ids_of_instances() const {
    std::vector<IdRange> ranges;
    for (const ObjectUse& use : world_.uses)
      ranges.push_back({use.first_triangle, world_.objects[use.object].assembly.triangles});
    for (const QuadricRun& run : world_.runs) ranges.push_back({run.first_triangle, run.places->size()});
    std::ranges::sort(ranges, {}, &IdRange::first);
    // One that continues the one before is one with it, as those of most scenes do.
    std::vector<IdRange> joined;
    for (const IdRange& range : ranges)
      if (!joined.empty() && joined.back().first + joined.back().count == range.first)
        joined.back().count += range.count;
      else
        joined.push_back(range);
    return joined;
  }

  const Scene& scene_;
  const PartitionOptions& options_;
  std::filesystem::path bundle_;
  bool median_;
  WorkEstimate work_;
  Phases phases_;
  World world_;
  SceneInstances instances_;
  SharedCells shared_;
  std::uint64_t items_ = 0;                  // triangles and instances
  std::uint64_t coarse_ = 0, quadrics_ = 0;  // as in ScenePlan, World
  double rest_ = 1;                          // of all work, without the objects'
  PartitionMemory plan_;
  Manifest manifest_;
  std::vector<std::uint64_t> block_hashes_;  // SceneTally's
  std::vector<std::string> shape_names_;
  std::vector<KeptGlazing> glazings_;
  std::uint64_t buckets_ = 1, spill_bytes_ = 0;
};

}  // namespace

std::uint64_t mesh_bytes_within(std::uint64_t memory_bytes) { return meshes_within(memory_bytes); }

PartitionStats partition(const Scene& scene, const std::filesystem::path& out,
                         const PartitionOptions& options,
                         const std::function<void(double, const char*)>& progress) {
  const auto start = Clock::now();
  const double cpu_start = cpu_seconds();
  PartitionOptions chosen = options;
  if (chosen.memory_bytes == 0) chosen.memory_bytes = memory_limit().share();
  BundleDirectory directory(out, options.durable);
  tbb::task_arena arena(arena_threads(options.threads));
  PartitionStats stats =
      arena.execute([&] { return Partitioner(scene, directory.path(), chosen, progress).run(); });
  directory.commit();
  stats.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  stats.cpu_s = cpu_seconds() - cpu_start;
  stats.peak_rss_bytes = peak_resident_bytes();
  stats.ledger = ledger_of(scene);
  stats.memory_budget_bytes = chosen.memory_bytes;
  stats.triangles_per_s = static_cast<double>(stats.input_triangles) / std::max(stats.wall_s, 1e-9);
  return stats;
}

}  // namespace vitrail
