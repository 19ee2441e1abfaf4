"""The parts of make_mannequin.py: body (what), shapes (implicit surfaces), surface (meshing), skin (weights), glb (file)."""
