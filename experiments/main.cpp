#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <iostream>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/program/program.hpp>

int main(int argc, char** argv) {
  // Started without stdin, stdout or stderr, the next file opened would take its number, and what is printed with it. To
  // print there fails, as on a full disk.
  while (true) {
    const int descriptor = ::open("/dev/null", O_RDONLY);
    if (descriptor > 2) ::close(descriptor);
    if (descriptor < 0 || descriptor > 2) break;
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow (ulimit -f) fails by its name, as on a full disk
  return thinwall::run_program({argv, argv + argc}, thinwall::experiments(), std::cout, std::cerr);
}
