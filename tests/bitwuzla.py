#!/usr/bin/env python3
"""Bitwuzla as a program: FILE of SMT-LIB text in, answers out. Its wheel is a Python module, beside this file as bitwuzla.so."""

import os
import sys

# Without pathlib, which takes longer to be imported than many a question to be answered.
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import bitwuzla  # noqa: E402

if sys.argv[1:] == ["--version"]:
    print(bitwuzla.version())
else:
    options = bitwuzla.Options()
    options.set(bitwuzla.Option.PRODUCE_MODELS, True)
    bitwuzla.Parser(bitwuzla.TermManager(), options).parse(sys.argv[1])
