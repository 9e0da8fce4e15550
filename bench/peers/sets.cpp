#include "peers/peer.hpp"

namespace thinwall::bench {

template const Shots<Ball, Box>& any_shots();
template const Shots<Ball, Ball>& any_shots();
template const Shots<Box, Box>& any_shots();
template const Shots<Ball, Pill>& any_shots();
template const Shots<Pill, Box>& any_shots();
template const Shots<Box, TurnedBox>& any_shots();
template const Rays<Ball>& any_rays();
template const Rays<Box>& any_rays();
template const Rays<TurnedBox>& any_rays();
template const Rays<Pill>& any_rays();
template const Poses<Ball, Ball>& any_poses();
template const Poses<Box, Box>& any_poses();
template const Poses<Ball, Box>& any_poses();
template const Poses<TurnedBox, TurnedBox>& any_poses();
template const Poses<Pill, Pill>& any_poses();

const Shots<Ball, Box>& wall_shots() { return thin_wall_shots(); }

}  // namespace thinwall::bench
