#include <thinwall/discrete/sphere.hpp>
int main() {}
