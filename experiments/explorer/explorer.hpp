#pragma once
/// What the page in page/ asks of the library: shots at the thin wall, what theory says, and advice, behind plain functions that
/// WebAssembly can export. One setting at a time; one thread.
///
/// Numbers are handed over in a list that explorer_numbers() points at, and each function returns how many it has put there.
/// Texts are UTF-8, ended by a zero; both hold until the next call. Methods are numbered as explorer_describe() lists them. Each of
/// them is asked in double.

#ifdef __wasm__
#define THINWALL_EXPORT(name) __attribute__((export_name(#name))) name
#else
#define THINWALL_EXPORT(name) name
#endif

extern "C" {

const double* THINWALL_EXPORT(explorer_numbers)();

/// JSON: the methods (name, color, mark), the factors (name, unit, lower, upper, whether those are allowed), the textbook's bullet.
const char* THINWALL_EXPORT(explorer_describe)();

/// Speed [m/s], step [s], radius [m], thickness [m] and angle of incidence [deg] at an infinite wall, and the seed, a whole number below
/// 2^53. Returns why it cannot be, and leaves everything as it was; or nothing, and forgets every shot.
const char* THINWALL_EXPORT(explorer_set)(double speed, double step, double radius, double thickness, double angle_deg,
                                          double seed);

/// Fires the next `count` shots at a method: the same as the experiment thin_wall fires.
void THINWALL_EXPORT(explorer_fire)(int method, int count);

/// Shots, tunneled, undecided; the share that tunneled, and its 95 % Wilson interval; lateness [m] of the detected: mean, largest. NaN is
/// what there is none of.
int THINWALL_EXPORT(explorer_tally)(int method);

/// The chance of tunneling; lateness [m], mean and largest. NaN where theory has none.
int THINWALL_EXPORT(explorer_theory)(int method);

/// [1] The step, as a multiple of what the ball crosses: v h cos(a) / (w + 2 r).
double THINWALL_EXPORT(explorer_step_ratio)();

/// The chance of tunneling at step ratios from `from` to `to`, `count` >= 2 of them, evenly on a logarithmic scale; all else as it is set.
int THINWALL_EXPORT(explorer_curve)(int method, double from, double to, int count);

/// One shot, of phase in [0, 1). x and y [m] of the start; of a step; half the wall's thickness, radius; path [m] to first contact;
/// then for each method the path [m] to where it sees a hit: NaN if the ball passes it, -1 if it gives up.
int THINWALL_EXPORT(explorer_shot)(double phase);

/// Times every method here, in about a second, and holds it against certified answers. For each: [ns] a step's median time, of the dearer
/// of two kinds, and its 95 % interval; of 4096 steps the wrong verdicts; the error of the time of the others as a length [m], its 99th
/// percentile and the largest.
int THINWALL_EXPORT(explorer_race)();

/// What to use if no more than `miss` [1] of the shots may tunnel, and none may be seen later than `late` [m] (< 0: no matter). Sentences.
/// After explorer_race(), whose times it needs, at any setting.
const char* THINWALL_EXPORT(explorer_advice)(double miss, double late);

/// The configuration of `thinwall run` that fires these shots, with what is wished as above.
const char* THINWALL_EXPORT(explorer_toml)(double miss, double late);

// ---- A rod that flies at the wall and spins: the ball's speed, step, radius and wall, and a length and a spin. explorer_set() comes first.
// Methods are numbered as explorer_rod_describe() lists them.

/// Where the numbers of the functions below are.
const double* THINWALL_EXPORT(explorer_rod_numbers)();

/// JSON: the methods for what turns (name, color, mark), and the factors length and spin.
const char* THINWALL_EXPORT(explorer_rod_describe)();

/// Speed [m/s], step [s], radius [m], thickness [m] as explorer_set(); the rod's length [m], end to end, and spin [rad/s] about
/// an axis across the flight; the seed. Returns why it cannot be, or nothing, and forgets every flight.
const char* THINWALL_EXPORT(explorer_rod_set)(double speed, double step, double radius, double thickness, double length,
                                              double spin, double seed);

/// What makes it a cell of the experiment: the step, as a multiple of wall and length together, and the turn [deg] a step.
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
