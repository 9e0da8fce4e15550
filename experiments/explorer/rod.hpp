#pragma once
/// What the page asks of a rod that flies at the wall and spins: the ball's speed, step, radius and wall, and a length and a spin. As
/// explorer.hpp has it; explorer_set() comes first. Methods are numbered as explorer_rod_describe() lists them.

#include <thinwall/experiments/explorer/explorer.hpp>

extern "C" {

/// Where the numbers of the functions below are.
const double* THINWALL_EXPORT(explorer_rod_numbers)();

/// JSON: the methods for what turns (name, color, mark), and the factors length and spin.
const char* THINWALL_EXPORT(explorer_rod_describe)();

/// Speed [m/s], step [s], radius [m], thickness [m] as explorer_set(); the rod's length [m], between the ends of its core, and spin [rad/s] about
/// an axis across the flight; the seed. Returns why it cannot be, or nothing, and forgets every flight.
const char* THINWALL_EXPORT(explorer_rod_set)(double speed, double step, double radius, double thickness, double length,
                                              double spin, double seed);

/// What makes it a cell of the experiment: the step, as a multiple of wall, radii and length together, and the turn [deg] a step.
int THINWALL_EXPORT(explorer_rod_cell)();

/// Fires the next `count` rods at a method: the same as the experiment spinning_rod fires.
void THINWALL_EXPORT(explorer_rod_fire)(int method, int count);

/// Flights, tunneled, undecided, hits in a step in which nothing touches; the share that tunneled, and its 95 % Wilson interval; the chance by theory;
/// lateness [steps]: the mean. NaN is what there is none of.
int THINWALL_EXPORT(explorer_rod_tally)(int method);

/// That multiple, and the chance of tunneling by theory at `count` >= 2 such ratios from `from` to `to`,
/// evenly on a logarithmic scale, the rod turning as far a step.
int THINWALL_EXPORT(explorer_rod_curve)(int method, double from, double to, int count);

/// One flight, by its number: half the length, radius, half the wall's thickness; x [m] of the start, the step [m], the angle [rad] at the start between
/// flight and rod, the turn [rad] a step; the steps until first contact, and those asked about; then for each method the steps until it sees a hit: NaN if the rod
/// passes it, -1 if it gives up.
int THINWALL_EXPORT(explorer_rod_shot)(int flight);
}
