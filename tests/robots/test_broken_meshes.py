"""URDFs that name files which are not the meshes that they should be."""

from __future__ import annotations

import pytest

from rgss.errors import DefinitionError
from tests.robots.test_foreign_urdfs import CLEAN, rationales


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("part.stl", b"version https://git-lfs.github.com/spec/v1\nsize 7\n", "part.stl is a pointer of Git LFS"),
        ("part.dae", b"<COLLADA>", "part.dae cannot be read as a mesh"),
        ("part.stl", b"", "part.stl is an empty file"),
        ("part.obj", b"no mesh", "part.obj is not a file of the format OBJ"),
    ],
)
def test_a_collision_mesh_that_is_no_mesh_is_refused_and_a_visual_one_left_out(tmp_path, draft, name, content, message):
    (package := tmp_path / "package").mkdir()
    (package / name).write_bytes(content)
    shape = f'<geometry><mesh filename="{name}"/></geometry>'
    with pytest.raises(DefinitionError, match=message):
        draft(CLEAN.replace("</link>", f"<collision>{shape}</collision></link>", 1))
    drafted = draft(CLEAN.replace("</link>", f"<visual>{shape}</visual></link>", 1))
    assert f"1 visual meshes are left out: {message}" in rationales(drafted)
