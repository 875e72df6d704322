#include "server/cli/cli.hpp"

int main(int argc, char** argv) { return bahnwerk::server::cli::run(argc, argv, bahnwerk::server::build_info()); }
