"""What the rooms rest on of the machine: kinds of compiled kernel, threads, the disk cache, digests, files written whole."""
