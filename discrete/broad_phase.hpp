#pragma once
/// Every way to find the pairs of bodies that may touch (docs/broad_phase.md). A new one is a header of its own and one
/// line here: tests, benchmarks and experiments loop over this list. The R-tree needs Boost.Geometry's headers.

#include <thinwall/discrete/broad_phase/all_pairs.hpp>
#include <thinwall/discrete/broad_phase/r_tree.hpp>
#include <thinwall/discrete/broad_phase/sort_and_sweep.hpp>
#include <thinwall/discrete/broad_phase/uniform_grid.hpp>
#include <thinwall/discrete/type_list.hpp>

namespace thinwall {

using BroadPhases = TypeList<  //
    AllPairs,                  //
    AllOrderedPairs,           //
    SortAndSweep,              //
    UniformGrid,               //
    RTree>;

}  // namespace thinwall
