#!/usr/bin/env python3
"""Bitwuzla as a program: FILE of SMT-LIB text in, answers out. Its wheel is a Python module, beside this file as bitwuzla.so."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import bitwuzla  # noqa: E402

if sys.argv[1:] == ["--version"]:
    print(bitwuzla.version())
else:
    options = bitwuzla.Options()
    options.set(bitwuzla.Option.PRODUCE_MODELS, True)
    bitwuzla.Parser(bitwuzla.TermManager(), options).parse(sys.argv[1])
