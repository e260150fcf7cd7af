#include "nodes/all_nodes.h"
