"""Folders of a project: where it is, and its sets of requirements."""

from rgss.studies.project_folders.locating import DEFAULT_STUDY, FOLDERS, find_project, project_of_study
from rgss.studies.project_folders.requirement_sets import (
    REQUIREMENT_PARTS,
    REQUIREMENTS,
    SINGLE_FILES,
    folder_problem,
    measures_of,
    named_sets,
    normal_folder,
    qualifier_of,
    requirements_named,
    requirements_of_study,
    studies_by_set,
)
from rgss.studies.project_folders.study_names import study_file, words_of_study
