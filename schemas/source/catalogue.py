"""All schemas: of the files that people write, the documents that the program writes, the tables of both."""

from analyses import ANALYSES
from check_settings import CHECK_SETTINGS
from cmm import CMM
from csv_tables import TABLES
from errors import ERRORS
from job import JOB
from lists import LISTS
from machine import MACHINE
from motion_test import MOTION_TEST
from motions import MOTIONS
from plan import PLAN
from results import RESULTS
from studies import HISTORY, IDENTIFICATION, POPULATION, VALUES
from tools import TOOLS

FILES = [JOB, MACHINE, ERRORS, PLAN, TOOLS, CMM, POPULATION, IDENTIFICATION, VALUES, MOTION_TEST, HISTORY, CHECK_SETTINGS]
DOCUMENTS = [*RESULTS, *ANALYSES, *MOTIONS, *LISTS]
TITLES = {schema.name: schema.title for schema in FILES}

__all__ = ["DOCUMENTS", "FILES", "TABLES", "TITLES"]
