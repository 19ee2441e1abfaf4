"""The parts of make_mannequin.py; README.md says what each holds."""
